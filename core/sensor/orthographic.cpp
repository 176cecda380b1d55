#include "core/sensor/orthographic.h"

namespace neumann {

namespace {

FilmPlane plane_of(const SensorOptions& options, const Film& film) {
    const double height = static_cast<double>(film.height) / film.width;
    const Vec3 left(options.to_world[0]), up(options.to_world[1]), ahead(options.to_world[2]);
    return {Vec3(options.to_world[3]) + left + up * height + ahead * options.near_clip, left * (-2.0 / film.width),
            up * (-2.0 / film.width)};
}

}  // namespace

// If to_world scales z, the near plane moves and the rays keep their length, as in Mitsuba.
Orthographic::Orthographic(const SensorOptions& options, const Film& film)
    : plane_(plane_of(options, film)),
      direction_(glm::normalize(Vec3(options.to_world[2]))),
      length_(options.far_clip - options.near_clip) {}

std::optional<FilmPoint> Orthographic::see(const Vec3& p, const Vec2&) const {
    const double cosine = glm::dot(direction_, plane_.normal()), depth = glm::dot(p - plane_.corner(), plane_.normal()) / cosine;
    if (!(depth > 0.0 && depth < length_)) return std::nullopt;
    const Vec3 start = p - direction_ * depth;
    return FilmPoint{
        plane_.position(start), {.position = start, .normal = -direction_}, -direction_, 1.0 / (plane_.area() * std::abs(cosine))};
}

}  // namespace neumann
