#include "core/emitter/spot_light.h"

#include "core/sampling/warp.h"

#include <cmath>

namespace neumann {

SpotLight::SpotLight(const Mat4& to_world, const Rgb& intensity, double cutoff, double beam_width, std::optional<Slide> slide,
                     Edge edge)
    : to_local_(glm::inverse(glm::dmat3(to_world))),
      position_(to_world[3]),
      intensity_(intensity),
      cutoff_(cutoff),
      beam_width_(beam_width),
      slide_(std::move(slide)),
      edge_(edge) {}

double SpotLight::falloff(double angle) const {
    if (angle <= beam_width_) return 1.0;
    if (edge_ == Edge::linear) return (cutoff_ - angle) / (cutoff_ - beam_width_);
    const double x = (std::cos(angle) - std::cos(cutoff_)) / (std::cos(beam_width_) - std::cos(cutoff_));
    return x * x * (3.0 - 2.0 * x);
}

Beam SpotLight::beam(const Vec3& at, const Surroundings&) const {
    const Vec3 d = at - position_, local = to_local_ * d;
    const double angle = std::atan2(std::hypot(local.x, local.y), local.z);
    if (angle >= cutoff_) return {position_};
    Rgb intensity = intensity_ * falloff(angle);
    if (slide_) intensity *= slide_->at(Vec2(0.5) + Vec2(local) * (0.5 / (local.z * std::tan(cutoff_))));
    return {position_, intensity / glm::dot(d, d)};
}

// The transform may scale. The angles are those in the light's own space, so the direction is sampled there and then transformed.
Vec3 SpotLight::sample_direction(const Vec2& u) const {
    return glm::normalize(glm::inverse(to_local_) * uniform_cone(u, std::cos(cutoff_)));
}

// dω_local / dω = |det M| / |M ω|³ for local = M ω.
double SpotLight::direction_pdf(const Vec3& w) const {
    const Vec3 local = to_local_ * w;
    const double length = glm::length(local);
    if (local.z < length * std::cos(cutoff_)) return 0.0;
    return std::abs(glm::determinant(to_local_)) / (length * length * length) / (2.0 * pi * (1.0 - std::cos(cutoff_)));
}

// The mean of the falloff over the cosines is 1 − slope; a smooth step is on average a half.
double SpotLight::brightness(const Surroundings&) const {
    const double width = cutoff_ - beam_width_, slope = edge_ == Edge::smooth ? 0.5 * (std::cos(beam_width_) + std::cos(cutoff_))
                                                        : width > 0.0         ? (std::sin(cutoff_) - std::sin(beam_width_)) / width
                                                                              : std::cos(cutoff_);
    return 2.0 * (1.0 - slope) * mean_component(intensity_) * (slide_ ? slide_->mean() : 1.0);
}

}  // namespace neumann
