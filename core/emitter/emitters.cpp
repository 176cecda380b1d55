#include "core/emitter/emitters.h"

#include <algorithm>
#include <numeric>

namespace neumann {

Emitters::Emitters(const Geometry& geometry, Lights lights)
    : lights_(std::move(lights)),
      shapes_(geometry.shared_shapes()),
      surroundings_{geometry.center(), geometry.radius()},
      powers_(lights_.of_shape.size(), 0.0) {
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape) {
        if (lights_.of_shape[shape] == none) continue;
        const double area = geometry.area(shape);
        without_area_ += area == 0.0;
        const Rgb& radiance = lights_.area[static_cast<std::size_t>(lights_.of_shape[shape])].largest;
        powers_[shape] = mean_component(radiance) * area;
        if (powers_[shape] > 0.0) largest_radiance_ = glm::max(largest_radiance_, radiance);
    }
    if (lights_.environment) {
        const double radius = surroundings_.radius > 0.0 ? surroundings_.radius : 1.0;
        largest_radiance_ = glm::max(largest_radiance_, largest(*lights_.environment));
        powers_.push_back(brightness(*lights_.environment) * pi * radius * radius);
    }
    for (const DeltaLight& light : lights_.delta) {
        powers_.push_back(brightness(light, surroundings_));
        if (powers_.back() > 0.0) largest_radiance_ = Rgb(std::numeric_limits<double>::infinity());
    }
}

bool Emitters::empty() const {
    return std::all_of(powers_.begin(), powers_.end(), [](double p) { return p == 0.0; });
}

DistantSample Emitters::sample_distant(std::size_t index, const Vec3& x, const Vec2& uv) const {
    DistantSample sample;
    if (lights_.environment && index == 0) {
        sample.w = neumann::sample(*lights_.environment, uv);
        sample.from = x + sample.w * (2.0 * surroundings_.radius + glm::distance(x, surroundings_.center));
        sample.pdf = environment_pdf(sample.w);
        if (sample.pdf > 0.0) sample.light = radiance(*lights_.environment, sample.w) / sample.pdf;
    } else {
        const Beam found = beam(lights_.delta[index - (lights_.environment ? 1 : 0)], x, surroundings_);
        sample = {found.from, glm::normalize(found.from - x), found.irradiance, delta_pdf};
    }
    return sample;
}

double Emitters::distant_irradiance(std::size_t index, const Vec3& x) const {
    if (lights_.environment && index == 0) return pi * brightness(*lights_.environment);
    return mean_component(beam(lights_.delta[index - (lights_.environment ? 1 : 0)], x, surroundings_).irradiance);
}

bool Emitters::is_grey() const {
    return std::all_of(lights_.area.begin(), lights_.area.end(),
                       [](const AreaLight& light) { return !light.function && neumann::is_grey(light.largest); }) &&
           (!lights_.environment || neumann::is_grey(*lights_.environment)) &&
           std::all_of(lights_.delta.begin(), lights_.delta.end(), [](const DeltaLight& light) { return neumann::is_grey(light); });
}

}  // namespace neumann
