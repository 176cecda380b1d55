#include "core/reader/formats/collada/view.h"

#include "core/reader/formats/collada/spot.h"
#include "core/reader/formats/collada/texts.h"

namespace neumann::reader::collada {

Mat4 view_of(const Bounds& scene, const Vec3& from, int up) {
    const Vec3 back = from / length_of(from);
    Vec3 above(0.0);
    above[up] = 1.0;
    if (length_of(glm::cross(above, back)) < 1e-6) above = Vec3(above.z, above.x, above.y);
    const Vec3 right = glm::normalize(glm::cross(above, back));
    const Vec3 position = scene.center() + back * (3.0 * scene.radius());
    return facing_back(
        {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0), glm::dvec4(position, 1.0)});
}

std::optional<Vec3> course_direction(const Instance& camera) {
    Vec3 direction(0.0);
    if (camera.is_placed) {
        direction = Vec3(camera.to_world[3]) - Vec3(camera.to_world[2]);
    } else {
        const Element* matrix = child(*camera.node, "matrix");
        if (!matrix) return std::nullopt;
        const std::vector<double> v = read_numbers(*matrix);
        if (v.size() < 12) return std::nullopt;
        direction = Vec3(v[3], v[7], v[11]) - Vec3(v[2], v[6], v[10]);
    }
    return length_of(direction) > 0.0 ? std::optional(direction) : std::nullopt;
}

Vec3 front(int up) { return up == 2 ? Vec3(0.0, -1.0, 0.0) : Vec3(0.0, 0.0, 1.0); }

}  // namespace neumann::reader::collada
