#include "core/sensor/thin_lens.h"

#include "core/sampling/warp.h"

namespace neumann {

ThinLens::ThinLens(const SensorOptions& options, const Film& film) : near_(options.near_clip), far_(options.far_clip) {
    const double aspect = static_cast<double>(film.width) / film.height;
    const double x = tan_half_width(options.fov, options.fov_axis, aspect), y = x / aspect;
    const Vec3 left(options.to_world[0]), up(options.to_world[1]), ahead(options.to_world[2]);
    const double f = options.focus_distance;
    origin_ = Vec3(options.to_world[3]);
    axis_ = glm::normalize(ahead);
    corner_ = (left * x + up * y + ahead) * f;
    across_ = left * (-2.0 * x / film.width * f);
    down_ = up * (-2.0 * y / film.height * f);
    lens_x_ = left * options.aperture_radius;
    lens_y_ = up * options.aperture_radius;
}

CameraRay ThinLens::ray(const Vec2& position, const Vec2& lens) const {
    const Vec2 disk = uniform_disk(lens);
    const Vec3 aside = lens_x_ * disk.x + lens_y_ * disk.y;
    const Vec3 direction = glm::normalize(corner_ + across_ * position.x + down_ * position.y - aside);
    const double along = 1.0 / glm::dot(direction, axis_);  // distance per unit of depth
    return {origin_ + aside + direction * (near_ * along), direction, (far_ - near_) * along};
}

}  // namespace neumann
