#include "core/emitter/emitters.h"

#include <algorithm>
#include <numeric>

namespace neumann {

namespace {

// The probabilities of lights of these powers: half as their power, half alike. A dim light may be the one that a place sees, and a
// bright one may be found by the material's directions.
std::vector<double> shares(const std::vector<double>& powers) {
    const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
    const auto lights = static_cast<double>(std::count_if(powers.begin(), powers.end(), [](double p) { return p > 0.0; }));
    std::vector<double> result;
    for (const double power : powers) result.push_back(power > 0.0 ? 0.5 * (power / total + 1.0 / lights) : 0.0);
    return result;
}

// Of the light with this index, where there are others: directions of the material find an environment anyway.
void limit_to_half(std::vector<double>& share, std::size_t index) {
    const double others = 1.0 - share[index];
    if (share[index] <= 0.5 || others <= 0.0) return;
    for (double& s : share) s *= 0.5 / others;
    share[index] = 0.5;
}

}  // namespace

void Emitters::add(double share) { cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + share); }

Emitters::Emitters(const Geometry& geometry, Lights lights)
    : lights_(std::move(lights)),
      shapes_(geometry.shared_shapes()),
      surroundings_{geometry.center(), geometry.radius()},
      density_of_shape_(lights_.of_shape.size(), 0.0) {
    std::vector<double> powers(lights_.of_shape.size(), 0.0);  // over π
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape) {
        if (lights_.of_shape[shape] == none) continue;
        const double area = geometry.area(shape);
        without_area_ += area == 0.0;
        const Rgb& radiance = lights_.area[static_cast<std::size_t>(lights_.of_shape[shape])].largest;
        powers[shape] = mean_component(radiance) * area;
        if (powers[shape] > 0.0) largest_radiance_ = glm::max(largest_radiance_, radiance);
    }
    if (lights_.environment) {
        const double radius = surroundings_.radius > 0.0 ? surroundings_.radius : 1.0;
        largest_radiance_ = glm::max(largest_radiance_, largest(*lights_.environment));
        powers.push_back(brightness(*lights_.environment) * pi * radius * radius);
    }
    for (const DeltaLight& light : lights_.delta) {
        powers.push_back(brightness(light, surroundings_));
        if (powers.back() > 0.0) largest_radiance_ = Rgb(std::numeric_limits<double>::infinity());
    }

    std::vector<double> share = shares(powers);
    if (lights_.environment) limit_to_half(share, lights_.of_shape.size());
    if (std::all_of(share.begin(), share.end(), [](double s) { return s == 0.0; })) return;
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape) {
        if (share[shape] == 0.0) continue;
        density_of_shape_[shape] = share[shape] / geometry.area(shape);
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive)
            if (const double area = geometry.area(shape, primitive); area > 0.0) {
                primitives_.push_back({shape, primitive});
                add(density_of_shape_[shape] * area);
            }
    }
    for (std::size_t i = lights_.of_shape.size(); i < share.size(); ++i) add(share[i]);
    if (lights_.environment) environment_share_ = share[lights_.of_shape.size()];
    // Sums of rounded numbers; the last is 1.
    const double all = cumulative_.back();
    for (double& c : cumulative_) c /= all;
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
