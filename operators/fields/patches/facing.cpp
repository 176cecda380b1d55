#include "operators/fields/patches/facing.h"

#include "core/geometry/shading_point.h"

#include <algorithm>

namespace neumann {

namespace {

// If there are more points, they are replaced by the corners of their bounding box.
constexpr std::size_t most_points = 1000;
constexpr double tolerance = 1e-6;

}  // namespace

Facing::Facing(const Geometry& geometry) : geometry_(geometry) {
    std::size_t points = 0;
    for (const Shape& shape : geometry.shapes()) {
        const auto* mesh = std::get_if<TriangleMesh>(&shape);
        points += mesh ? 3 * mesh->triangles.size() : 1;
    }
    if (points > most_points) {
        Bounds bounds;
        for (const Shape& shape : geometry.shapes()) bounds.add(bounds_of(shape));
        const Vec3 ends[] = {bounds.low, bounds.high};
        for (unsigned i = 0; i < 8; ++i) balls_.push_back({{ends[i & 1u].x, ends[i >> 1u & 1u].y, ends[i >> 2u].z}, 0.0});
        return;
    }
    for (const Shape& shape : geometry.shapes()) {
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
            for (const auto& triangle : mesh->triangles)
                for (const std::uint32_t index : triangle) balls_.push_back({mesh->vertices[index], 0.0});
        } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
            balls_.push_back({sphere->center, sphere->radius});
        } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
            balls_.push_back({cylinder->center(), glm::length(cylinder->extent())});
        } else if (const auto* disk = std::get_if<Disk>(&shape)) {
            balls_.push_back({disk->center, std::sqrt(glm::dot(disk->u, disk->u) + glm::dot(disk->v, disk->v))});
        } else {
            const Bounds bounds = bounds_of(shape);
            balls_.push_back({bounds.center(), bounds.radius()});
        }
    }
}

bool Facing::nothing(const Chart& chart, bool front) const {
    const double slack = tolerance * geometry_.radius();
    if (const auto* sphere = std::get_if<Sphere>(&geometry_.shapes()[chart.shape()])) {
        if (front == sphere->flip_normals) return false;  // the inside
        return std::all_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
            return glm::distance(ball.center, sphere->center) + ball.radius <= sphere->radius + slack;
        });
    }
    if (chart.clusters() || has_smooth_normals(geometry_.shapes()[chart.shape()]) ||
        std::holds_alternative<Cylinder>(geometry_.shapes()[chart.shape()]))
        return false;
    const SurfacePoint p = chart.point(geometry_, Vec2(0.5));
    const Vec3 normal = front ? p.normal : -p.normal;
    return std::all_of(balls_.begin(), balls_.end(),
                       [&](const Ball& ball) { return glm::dot(ball.center - p.position, normal) + ball.radius <= slack; });
}

}  // namespace neumann
