#include "core/sensor/sensor_options.h"

namespace neumann {

FilmPlane::FilmPlane(const Vec3& corner, const Vec3& across, const Vec3& down) : corner_(corner), across_(across), down_(down) {
    const Vec3 n = glm::cross(across, down);
    const double square = glm::dot(n, n);
    dual_across_ = glm::cross(down, n) / square;
    dual_down_ = glm::cross(n, across) / square;
    area_ = std::sqrt(square);
    normal_ = n / area_;
}

}  // namespace neumann
