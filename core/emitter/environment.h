// Light from infinitely far away, from all directions.
#pragma once

#include "core/emitter/environment_map.h"
#include "core/emitter/sun_sky.h"
#include "core/sampling/warp.h"

#include <variant>

namespace neumann {

// The same radiance from all directions (Mitsuba's `constant`).
class ConstantEnvironment {
public:
    explicit ConstantEnvironment(const Rgb& radiance) : radiance_(radiance) {}

    Rgb radiance(const Vec3&) const { return radiance_; }
    Vec3 sample(const Vec2& u) const { return uniform_sphere(u); }
    double pdf(const Vec3&) const { return 0.25 * inv_pi; }
    Rgb largest() const { return radiance_; }
    double brightness() const { return mean_component(radiance_); }
    bool is_grey() const { return neumann::is_grey(radiance_); }

private:
    Rgb radiance_;
};

using Environment = std::variant<ConstantEnvironment, EnvironmentMap, SunSky>;

// The radiance that arrives from direction w.
inline Rgb radiance(const Environment& e, const Vec3& w) {
    return std::visit([&](const auto& x) { return x.radiance(w); }, e);
}
// Samples a direction towards the environment with the pdf pdf(), per solid angle.
inline Vec3 sample(const Environment& e, const Vec2& u) {
    return std::visit([&](const auto& x) { return x.sample(u); }, e);
}
inline double pdf(const Environment& e, const Vec3& w) {
    return std::visit([&](const auto& x) { return x.pdf(w); }, e);
}
// An upper bound of the radiance in each channel.
inline Rgb largest(const Environment& e) {
    return std::visit([](const auto& x) { return x.largest(); }, e);
}
// The mean radiance over all directions, as a weighted mean of the channels; positive if there is light.
inline double brightness(const Environment& e) {
    return std::visit([](const auto& x) { return x.brightness(); }, e);
}
inline bool is_grey(const Environment& e) {
    return std::visit([](const auto& x) { return x.is_grey(); }, e);
}

}  // namespace neumann
