#include "core/emitter/emitters.h"

#include <algorithm>

namespace neumann {

void Emitters::add(double brightness) { cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + brightness); }

Emitters::Emitters(const Geometry& geometry, Lights lights)
    : lights_(std::move(lights)),
      shapes_(geometry.shared_shapes()),
      surroundings_{geometry.center(), geometry.radius()},
      density_of_shape_(lights_.of_shape.size(), 0.0) {
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape) {
        if (lights_.of_shape[shape] == none) continue;
        if (geometry.area(shape) == 0.0) {
            ++without_area_;
            continue;
        }
        const Rgb& radiance = lights_.area[static_cast<std::size_t>(lights_.of_shape[shape])].largest;
        const double brightness = mean_component(radiance);
        if (brightness == 0.0) continue;
        largest_radiance_ = glm::max(largest_radiance_, radiance);
        density_of_shape_[shape] = brightness;
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive) {
            const double weight = brightness * geometry.area(shape, primitive);
            if (weight == 0.0) continue;
            primitives_.push_back({shape, primitive});
            add(weight);
        }
    }
    const double sphere = surroundings_.radius > 0.0 ? pi * surroundings_.radius * surroundings_.radius : 1.0;
    if (lights_.environment) {
        largest_radiance_ = glm::max(largest_radiance_, largest(*lights_.environment));
        environment_share_ = brightness(*lights_.environment) * sphere;
        add(environment_share_);
    }
    for (const DeltaLight& light : lights_.delta) {
        const double power = brightness(light, surroundings_);
        if (power > 0.0) largest_radiance_ = Rgb(std::numeric_limits<double>::infinity());
        add(power);
    }
    const double total = cumulative_.empty() ? 0.0 : cumulative_.back();
    if (total == 0.0) {
        cumulative_.clear();
        return;
    }
    for (double& c : cumulative_) c /= total;
    for (double& d : density_of_shape_)
        if (d != 0.0) d /= total;
    environment_share_ /= total;
}

// `index`: 0 is the environment where there is one. `share`: the probability of having been chosen.
LightSample Emitters::sample_distant(std::size_t index, double share, const Vec3& x, const Vec2& uv, double low) const {
    LightSample light;
    if (lights_.environment && index == 0) {
        light.w = neumann::sample(*lights_.environment, {std::min((uv.x - low) / share, 0x1.fffffffffffffp-1), uv.y});
        light.point.position = x + light.w * (2.0 * surroundings_.radius + glm::distance(x, surroundings_.center));
        light.pdf = share * neumann::pdf(*lights_.environment, light.w);
        if (light.pdf > 0.0) light.weight = radiance(*lights_.environment, light.w) / light.pdf;
    } else {
        const Beam found = beam(lights_.delta[index - (lights_.environment ? 1 : 0)], x, surroundings_);
        light.point.position = found.from;
        light.w = glm::normalize(found.from - x);
        light.weight = found.irradiance / share;
        light.pdf = delta_pdf;
    }
    light.point.normal = -light.w;
    light.point.shape = SurfacePoint::infinity;
    return light;
}

bool Emitters::is_grey() const {
    return std::all_of(lights_.area.begin(), lights_.area.end(),
                       [](const AreaLight& light) { return !light.function && neumann::is_grey(light.largest); }) &&
           (!lights_.environment || neumann::is_grey(*lights_.environment)) &&
           std::all_of(lights_.delta.begin(), lights_.delta.end(), [](const DeltaLight& light) { return neumann::is_grey(light); });
}

}  // namespace neumann
