// Lights without extent: rays cannot hit them, only light sampling finds them. They give the irradiance on a surface that faces
// them.
#pragma once

#include "core/emitter/beam.h"
#include "core/emitter/directional_area.h"
#include "core/emitter/projector_light.h"
#include "core/emitter/spot_light.h"
#include "core/sampling/warp.h"

#include <variant>

namespace neumann {

// The same radiant intensity in all directions (Mitsuba's `point`): I / d².
class PointLight {
public:
    PointLight(const Vec3& position, const Rgb& intensity) : position_(position), intensity_(intensity) {}

    Beam beam(const Vec3& at, const Surroundings&) const {
        const Vec3 d = at - position_;
        return {position_, intensity_ / glm::dot(d, d)};
    }
    // The total power divided by π, which is area times radiance of a diffuse emitter of the same power.
    double brightness(const Surroundings&) const { return 4.0 * mean_component(intensity_); }
    bool is_grey() const { return neumann::is_grey(intensity_); }

    const Vec3& position() const { return position_; }
    // Samples a direction of emission with the pdf direction_pdf(), per solid angle.
    Vec3 sample_direction(const Vec2& u) const { return uniform_sphere(u); }
    double direction_pdf(const Vec3&) const { return 0.25 * inv_pi; }

private:
    Vec3 position_;
    Rgb intensity_;
};

// Parallel light from infinitely far away (Mitsuba's `directional`).
class DirectionalLight {
public:
    // `direction` is the one in which the light travels.
    DirectionalLight(const Vec3& direction, const Rgb& irradiance) : direction_(direction), irradiance_(irradiance) {}

    Beam beam(const Vec3& at, const Surroundings& scene) const {
        return {at - direction_ * (2.0 * scene.radius + glm::distance(at, scene.center)), irradiance_};
    }
    double brightness(const Surroundings& scene) const { return scene.radius * scene.radius * mean_component(irradiance_); }
    bool is_grey() const { return neumann::is_grey(irradiance_); }
    const Vec3& direction() const { return direction_; }

private:
    Vec3 direction_;
    Rgb irradiance_;
};

using DeltaLight = std::variant<PointLight, DirectionalLight, SpotLight, ProjectorLight, DirectionalArea>;

inline Beam beam(const DeltaLight& light, const Vec3& at, const Surroundings& scene) {
    return std::visit([&](const auto& x) { return x.beam(at, scene); }, light);
}
inline double brightness(const DeltaLight& light, const Surroundings& scene) {
    return std::visit([&](const auto& x) { return x.brightness(scene); }, light);
}
inline bool is_grey(const DeltaLight& light) {
    return std::visit([](const auto& x) { return x.is_grey(); }, light);
}

}  // namespace neumann
