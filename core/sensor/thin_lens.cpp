#include "core/sensor/thin_lens.h"

#include "core/sampling/warp.h"
#include "core/sensor/perspective.h"

namespace neumann {

namespace {

FilmPlane plane_in_focus(const SensorOptions& options, const Film& film) {
    const double aspect = static_cast<double>(film.width) / film.height;
    const double x = tan_half_width(options.fov, options.fov_axis, aspect), y = x / aspect;
    const Vec3 left(options.to_world[0]), up(options.to_world[1]), ahead(options.to_world[2]);
    const double f = options.focus_distance;
    return {(left * x + up * y + ahead) * f, left * (-2.0 * x / film.width * f), up * (-2.0 * y / film.height * f)};
}

}  // namespace

ThinLens::ThinLens(const SensorOptions& options, const Film& film)
    : origin_(options.to_world[3]),
      plane_(plane_in_focus(options, film)),
      lens_x_(Vec3(options.to_world[0]) * options.aperture_radius),
      lens_y_(Vec3(options.to_world[1]) * options.aperture_radius),
      axis_(glm::normalize(Vec3(options.to_world[2]))),
      near_(options.near_clip),
      far_(options.far_clip) {}

Vec3 ThinLens::aside(const Vec2& lens) const {
    const Vec2 disk = uniform_disk(lens);
    return lens_x_ * disk.x + lens_y_ * disk.y;
}

CameraRay ThinLens::ray(const Vec2& position, const Vec2& lens) const {
    const Vec3 from = aside(lens), direction = glm::normalize(plane_.at(position) - from);
    const double along = 1.0 / glm::dot(direction, axis_);  // distance per unit of depth
    return {origin_ + from + direction * (near_ * along), direction, (far_ - near_) * along};
}

std::optional<FilmPoint> ThinLens::see(const Vec3& p, const Vec2& lens) const {
    const Vec3 from = aside(lens);
    return see_through(origin_ + from, plane_.from(from), axis_, near_, far_, p);
}

double ThinLens::pixels_per_area(const CameraRay& ray, const Vec3& p) const {
    const double distance = glm::distance(ray.origin, p) + near_ / glm::dot(ray.direction, axis_);  // from the lens
    return plane_.pixels_per_solid_angle(ray.direction) / (distance * distance);
}

}  // namespace neumann
