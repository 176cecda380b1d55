#include "operators/patches/facing.h"

#include <algorithm>

namespace neumann {

namespace {

// If there are more points, they are replaced by the corners of their bounding box.
constexpr std::size_t most_points = 1000;
constexpr double tolerance = 1e-6;

}  // namespace

Facing::Facing(const Geometry& geometry) : geometry_(geometry) {
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
    if (balls_.size() <= most_points) return;
    Vec3 low = balls_.front().center, high = low;
    for (const Ball& ball : balls_) {
        low = glm::min(low, ball.center - ball.radius);
        high = glm::max(high, ball.center + ball.radius);
    }
    balls_.clear();
    for (int corner = 0; corner < 8; ++corner)
        balls_.push_back({{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z}, 0.0});
}

bool Facing::nothing(const Chart& chart, bool front) const {
    const double slack = tolerance * geometry_.radius();
    if (const auto* sphere = std::get_if<Sphere>(&geometry_.shapes()[chart.shape()])) {
        if (front == sphere->flip_normals) return false;  // the inside
        return std::all_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
            return glm::distance(ball.center, sphere->center) + ball.radius <= sphere->radius + slack;
        });
    }
    if (chart.clusters() || std::holds_alternative<Cylinder>(geometry_.shapes()[chart.shape()])) return false;
    const SurfacePoint p = chart.point(geometry_, Vec2(0.5));
    const Vec3 normal = front ? p.normal : -p.normal;
    return std::all_of(balls_.begin(), balls_.end(),
                       [&](const Ball& ball) { return glm::dot(ball.center - p.position, normal) + ball.radius <= slack; });
}

}  // namespace neumann
