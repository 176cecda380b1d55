#include "core/sensor/orthographic.h"

namespace neumann {

// Where to_world scales z, the near plane moves and the rays keep their length, as in Mitsuba.
Orthographic::Orthographic(const SensorOptions& options, const Film& film) : length_(options.far_clip - options.near_clip) {
    const double height = static_cast<double>(film.height) / film.width;
    const Vec3 left(options.to_world[0]), up(options.to_world[1]), ahead(options.to_world[2]);
    corner_ = Vec3(options.to_world[3]) + left + up * height + ahead * options.near_clip;
    across_ = left * (-2.0 / film.width);
    down_ = up * (-2.0 / film.width);
    direction_ = glm::normalize(ahead);
}

}  // namespace neumann
