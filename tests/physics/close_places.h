// Where scenes of surfaces that are close to each other stand.
#pragma once

#include "core/geometry/geometry.h"
#include "core/geometry/transformed.h"

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace neumann::close_places {

struct Place {
    const char* name;
    Mat4 to_world;
};
inline const Place places[] = {
    {"at the origin", Mat4(1.0)},
    {"turned", glm::rotate(Mat4(1.0), 1.1, glm::normalize(Vec3(1, 2, 3)))},
    {"turned and 1 km away", glm::rotate(glm::translate(Mat4(1.0), Vec3(700, -600, 400)), 1.1, glm::normalize(Vec3(1, 2, 3)))},
};

// As in files, a cube that is moved and scaled.
inline TriangleMesh box(const Vec3& low, const Vec3& high) {
    return make_cube(glm::scale(glm::translate(Mat4(1.0), 0.5 * (low + high)), 0.5 * (high - low)));
}
inline Geometry placed(const std::vector<TriangleMesh>& meshes, const Mat4& to_world) {
    std::vector<Shape> shapes;
    for (const TriangleMesh& mesh : meshes) shapes.emplace_back(transformed(mesh, to_world));
    return Geometry(std::move(shapes));
}

}  // namespace neumann::close_places
