#include "core/sensor/distant.h"

#include "core/base/error.h"
#include "core/base/frame.h"
#include "core/sampling/warp.h"

namespace neumann {

DistantSensor::DistantSensor(const SensorOptions& options, const Film& film, const Geometry& scene)
    : direction_(glm::normalize(Vec3(options.to_world[2]))),
      center_(scene.center()),
      radius_(scene.radius() > 0.0 ? scene.radius() : 1.0),
      film_(film) {
    if (const auto* point = std::get_if<Vec3>(&options.target)) {
        target_ = *point;
    } else if (const auto* shape = std::get_if<std::shared_ptr<const Shape>>(&options.target)) {
        const auto target = std::make_shared<const Target>(**shape);
        if (!(target->points.area() > 0.0)) throw InputError("the target of sensor 'distant' has no area");
        target_ = target;
    }
}

Vec3 DistantSensor::aim(const Vec2& u) const {
    if (const auto* point = std::get_if<Vec3>(&target_)) return *point;
    if (const auto* shape = std::get_if<std::shared_ptr<const Target>>(&target_)) return (*shape)->points.sample(u).position;
    const Frame across(direction_);
    const Vec2 disk = uniform_disk(u) * radius_;
    return center_ + across.s * disk.x + across.t * disk.y;
}

Vec3 DistantSensor::beyond_scene(const Vec3& p) const { return p - direction_ * (2.0 * radius_ + glm::distance(p, center_)); }

CameraRay DistantSensor::ray(const Vec2& position, const Vec2&) const {
    return {beyond_scene(aim(place_in_pixel(position))), direction_};
}

// A ray through p passes points of the target, each of which has the density 1/A per area of the target and 1/(A |cosθ|) across.
double DistantSensor::density(const Vec3& p) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (is_single_ray()) return infinity;
    const auto* shape = std::get_if<std::shared_ptr<const Target>>(&target_);
    if (!shape) return 1.0 / (pi * radius_ * radius_);
    const Target& target = **shape;
    const Vec3 far = p - direction_ * (2.0 * target.geometry.radius() + glm::distance(p, target.geometry.center()));
    double sum = 0.0;
    SurfacePoint met;
    for (bool meets = target.geometry.first_hit(far, direction_, infinity, met); meets;
         meets = target.geometry.first_hit(met, direction_, met))
        sum += 1.0 / std::abs(glm::dot(met.normal, direction_));
    return sum / target.points.area();
}

std::optional<FilmPoint> DistantSensor::see(const Vec3& p, const Vec2& lens) const {
    if (is_single_ray()) return std::nullopt;
    const double here = density(p);
    if (here == 0.0) return std::nullopt;
    return FilmPoint{
        film_.choose(lens).position, {.position = beyond_scene(p), .normal = -direction_}, -direction_, film_.pixels() * here};
}

}  // namespace neumann
