#include "core/emitter/projector_light.h"

#include "core/sampling/warp.h"

namespace neumann {

ProjectorLight::ProjectorLight(const Mat4& to_world, Slide slide, double scale, double half_width)
    : to_local_(glm::inverse(glm::dmat3(to_world))),
      position_(to_world[3]),
      slide_(std::move(slide)),
      scale_(scale),
      half_size_(half_width, half_width / slide_.aspect()) {}

// The irradiance is π E / (z² cosθ): on a surface perpendicular to the axis at z = 1, the factor cosθ cancels.
Beam ProjectorLight::beam(const Vec3& at, const Surroundings&) const {
    const Vec3 local = to_local_ * (at - position_);
    if (!(local.z > 0.0)) return {position_};
    const Vec2 uv = Vec2(0.5) - Vec2(local) / (half_size_ * (2.0 * local.z));
    if (uv.x < 0.0 || uv.x > 1.0 || uv.y < 0.0 || uv.y > 1.0) return {position_};
    return {position_, slide_.at(uv) * (pi * scale_ * glm::length(local) / (local.z * local.z * local.z))};
}

Vec3 ProjectorLight::sample_direction(const Vec2& u) const {
    return glm::normalize(glm::inverse(to_local_) * Vec3((2.0 * u - 1.0) * half_size_, 1.0));
}

// The pdf per solid angle of a uniform point on the picture, which lies at z = 1; to_world does not scale.
double ProjectorLight::direction_pdf(const Vec3& w) const {
    const Vec3 local = to_local_ * w;
    if (!(local.z > 0.0) || std::abs(local.x) > half_size_.x * local.z || std::abs(local.y) > half_size_.y * local.z) return 0.0;
    return 1.0 / (4.0 * half_size_.x * half_size_.y * local.z * local.z * local.z);
}

}  // namespace neumann
