#include "core/emitter/emitters.h"

#include "core/base/frame.h"

#include <algorithm>
#include <numeric>

namespace neumann {

Emitters::Emitters(const Geometry& geometry, Lights lights)
    : lights_(std::move(lights)),
      shapes_(geometry.shared_shapes()),
      surroundings_{geometry.center(), geometry.radius()},
      powers_(lights_.of_shape.size(), 0.0),
      areas_(lights_.of_shape.size(), 0.0) {
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape)
        if (lights_.of_shape[shape] != none) areas_[shape] = geometry.area(shape);
    divide_lights(geometry);
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape) {
        if (lights_.of_shape[shape] == none) continue;
        without_area_ += areas_[shape] == 0.0;
        const Rgb& radiance = lights_.area[static_cast<std::size_t>(lights_.of_shape[shape])].largest;
        powers_[shape] = mean_component(radiance) * areas_[shape];
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

void Emitters::divide_lights(const Geometry& geometry) {
    for (std::uint32_t shape = 0; shape < lights_.of_shape.size(); ++shape) {
        if (lights_.of_shape[shape] == none) continue;
        const AreaLight& light = lights_.area[static_cast<std::size_t>(lights_.of_shape[shape])];
        if (light.along_normal && areas_[shape] > 0.0) lights_.delta.emplace_back(DirectionalArea(geometry, shape, light));
    }
    for (AreaLight& light : lights_.area)
        if (light.along_normal) light = Rgb(0.0);
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
        const Beam found = beam(delta_light(index), x, surroundings_);
        sample = {found.from, glm::normalize(found.from - x), found.irradiance, delta_pdf};
    }
    return sample;
}

DistantEmission Emitters::send_distant(std::size_t index, const Vec2& place, const Vec2& direction) const {
    const double radius = surroundings_.radius;
    // A point outside the scene, such that its ray along w hits a sampled point of the disc through the centre, perpendicular to w.
    const auto from_afar = [&](const Vec3& w) {
        const Frame across(w);
        const Vec2 disk = uniform_disk(place) * radius;
        return surroundings_.center + across.s * disk.x + across.t * disk.y - w * (2.0 * radius);
    };
    DistantEmission sent;
    if (lights_.environment && index == 0) {
        const Vec3 towards = neumann::sample(*lights_.environment, direction);
        sent.w = -towards;
        sent.from = from_afar(sent.w);
        sent.pdf = environment_pdf(towards) / (pi * radius * radius);
        if (sent.pdf > 0.0) sent.light = radiance(*lights_.environment, towards) / sent.pdf;
        return sent;
    }
    sent.is_delta = true;
    std::visit(
        [&](const auto& light) {
            if constexpr (requires { light.direction(); }) {
                sent.w = light.direction();
                sent.from = from_afar(sent.w);
                sent.pdf = 1.0 / (pi * radius * radius);
                sent.light = light.beam(sent.from, surroundings_).irradiance / sent.pdf;
            } else if constexpr (requires { light.start(place); }) {
                sent.w = light.normal();
                sent.from = light.start(place);
                sent.pdf = light.density();
                sent.light = light.exitance(sent.from) / sent.pdf;
            } else {
                sent.is_point = true;
                sent.from = light.position();
                sent.w = light.sample_direction(direction);
                sent.pdf = light.direction_pdf(sent.w);
                // The intensity is the irradiance at distance 1, computed at the scene's distance for accuracy.
                if (sent.pdf > 0.0)
                    sent.light = light.beam(sent.from + sent.w * radius, surroundings_).irradiance * (radius * radius / sent.pdf);
            }
        },
        delta_light(index));
    return sent;
}

double Emitters::distant_density(std::size_t index, const Vec3& x, const Vec3& w) const {
    const double disk = pi * surroundings_.radius * surroundings_.radius;
    if (lights_.environment && index == 0) return environment_pdf(-w) / disk;
    return std::visit(
        [&](const auto& light) {
            if constexpr (requires { light.direction(); }) {
                return 1.0 / disk;
            } else if constexpr (requires { light.density(); }) {
                return light.lights(x) ? light.density() : 0.0;
            } else {
                const Vec3 d = x - light.position();
                return light.direction_pdf(w) / glm::dot(d, d);
            }
        },
        delta_light(index));
}

std::optional<Vec3> Emitters::position_of_distant(std::size_t index) const {
    if (lights_.environment && index == 0) return std::nullopt;
    return std::visit(
        [](const auto& light) -> std::optional<Vec3> {
            if constexpr (requires { light.position(); }) return light.position();
            return std::nullopt;
        },
        delta_light(index));
}

double Emitters::distant_irradiance(std::size_t index, const Vec3& x) const {
    if (lights_.environment && index == 0) return pi * brightness(*lights_.environment);
    return mean_component(beam(delta_light(index), x, surroundings_).irradiance);
}

bool Emitters::shapes_shine_evenly() const {
    return std::none_of(lights_.area.begin(), lights_.area.end(), [](const AreaLight& light) { return bool(light.function); });
}

bool Emitters::is_grey() const {
    return shapes_shine_evenly() &&
           std::all_of(lights_.area.begin(), lights_.area.end(),
                       [](const AreaLight& light) { return neumann::is_grey(light.largest); }) &&
           (!lights_.environment || neumann::is_grey(*lights_.environment)) &&
           std::all_of(lights_.delta.begin(), lights_.delta.end(), [](const DeltaLight& light) { return neumann::is_grey(light); });
}

}  // namespace neumann
