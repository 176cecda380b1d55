#include "core/sensor/hemisphere.h"

namespace neumann {

Hemisphere::Hemisphere(const SensorOptions& options, const Film& film)
    : origin_(options.to_world[3]),
      left_(glm::normalize(Vec3(options.to_world[0]))),
      up_(glm::normalize(Vec3(options.to_world[1]))),
      normal_(glm::normalize(Vec3(options.to_world[2]))),
      size_(film.width, film.height) {}

CameraRay Hemisphere::ray(const Vec2& position, const Vec2&) const {
    Vec2 u = on_disc(position);
    const double r2 = glm::dot(u, u);
    if (r2 > 1.0) u /= std::sqrt(r2);  // of a corner, where the response is 0: any direction will do
    const double z = std::sqrt(std::max(1.0 - r2, 0.0));
    return {origin_, glm::normalize(left_ * u.x + up_ * u.y + normal_ * z)};
}

std::optional<FilmPoint> Hemisphere::see(const Vec3& p, const Vec2&) const {
    const Vec3 d = p - origin_;
    const double distance2 = glm::dot(d, d);
    if (!(distance2 > 0.0)) return std::nullopt;
    const Vec3 direction = d / std::sqrt(distance2);
    if (!(glm::dot(direction, normal_) > 0.0)) return std::nullopt;
    const Vec2 u(glm::dot(direction, left_), glm::dot(direction, up_));
    return FilmPoint{(1.0 - u) * 0.5 * size_, {.position = origin_, .normal = -direction}, -direction, density(direction, d)};
}

double Hemisphere::response(const Vec2& position) const {
    const Vec2 u = on_disc(position);
    return glm::dot(u, u) < 1.0 ? 1.0 : 0.0;
}

}  // namespace neumann
