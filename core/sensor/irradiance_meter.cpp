#include "core/sensor/irradiance_meter.h"

#include "core/base/error.h"
#include "core/base/frame.h"

namespace neumann {

IrradianceMeter::IrradianceMeter(const Geometry& geometry, std::uint32_t shape, const Film& film)
    : points_(std::make_shared<const AreaSampler>(geometry, shape)), film_(film) {
    if (!(points_->area() > 0.0)) throw InputError("the shape of sensor 'irradiancemeter' has no area");
}

CameraRay IrradianceMeter::ray(const Vec2& position, const Vec2& lens) const {
    const SurfacePoint p = points_->sample(place_in_pixel(position));
    const Vec3 local = cosine_hemisphere(lens);
    CameraRay ray;
    ray.origin = Geometry::leave(p, 1.0);
    ray.direction = Frame(p.normal).to_world(local);
    ray.cosine = local.z;
    return ray;
}

std::optional<FilmPoint> IrradianceMeter::see(const Vec3& p, const Vec2& lens) const {
    const auto [position, left] = film_.choose(lens);
    const SurfacePoint on = points_->sample(left);
    const Vec3 d = p - Geometry::leave(on, 1.0);
    const double distance2 = glm::dot(d, d);
    if (!(distance2 > 0.0)) return std::nullopt;
    const Vec3 direction = d / std::sqrt(distance2);
    const double cosine = glm::dot(on.normal, direction);
    if (!(cosine > 0.0)) return std::nullopt;
    return FilmPoint{position, on, -direction, density(cosine, d), response()};
}

}  // namespace neumann
