// Where scenes of surfaces that are close to each other stand.
#pragma once

#include "core/geometry/geometry.h"
#include "core/geometry/transformed.h"

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace neumann::close_places {

struct Placement {
    const char* name;
    Mat4 to_world;
};
inline const Placement places[] = {
    {"at the origin", Mat4(1.0)},
    {"turned", glm::rotate(Mat4(1.0), 1.1, glm::normalize(Vec3(1, 2, 3)))},
    {"turned and 1 km away", glm::rotate(glm::translate(Mat4(1.0), Vec3(700, -600, 400)), 1.1, glm::normalize(Vec3(1, 2, 3)))},
};

// As in files, a cube that is moved and scaled.
inline TriangleMesh box(const Vec3& low, const Vec3& high) {
    return make_cube(glm::scale(glm::translate(Mat4(1.0), 0.5 * (low + high)), 0.5 * (high - low)));
}
// Each mesh in coordinates of its own, which are stretched and turned, and every second one mirrored.
inline Geometry placed_as_instances(const std::vector<TriangleMesh>& meshes, const Mat4& to_world) {
    std::vector<Shape> shapes;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Mat4 own = glm::scale(glm::rotate(Mat4(1.0), 0.7, Vec3(0.6, 0, 0.8)), Vec3(i % 2 ? -0.1 : 0.1, 0.3, 0.2));
        shapes.emplace_back(
            MeshInstance(std::make_shared<const SharedMesh>(transformed(meshes[i], glm::inverse(own))), to_world * own));
    }
    return Geometry(std::move(shapes));
}
inline Geometry placed(const std::vector<TriangleMesh>& meshes, const Mat4& to_world) {
    std::vector<Shape> shapes;
    for (const TriangleMesh& mesh : meshes) shapes.emplace_back(transformed(mesh, to_world));
    return Geometry(std::move(shapes));
}

}  // namespace neumann::close_places
