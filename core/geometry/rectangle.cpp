#include "core/geometry/rectangle.h"

#include <algorithm>
#include <array>

namespace neumann {

std::optional<Rectangle> rectangle_of(const TriangleMesh& mesh, std::size_t first) {
    constexpr double rounding = 1e-12;
    if (first + 1 >= mesh.triangles.size()) return std::nullopt;
    const auto corners = [&](std::size_t triangle) {
        const auto& t = mesh.triangles[triangle];
        return std::array{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    };
    const auto normal = [](const std::array<Vec3, 3>& v) { return glm::cross(v[1] - v[0], v[2] - v[0]); };
    const auto one = corners(first), other = corners(first + 1);
    if (!(glm::dot(normal(one), normal(other)) > 0.0)) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
        const Rectangle r{one[k], one[(k + 1) % 3] - one[k], one[(k + 2) % 3] - one[k]};
        const double a = glm::length(r.a), b = glm::length(r.b);
        if (std::abs(glm::dot(r.a, r.b)) > rounding * a * b) continue;
        const auto has = [&](const Vec3& p) {
            return std::any_of(other.begin(), other.end(),
                               [&](const Vec3& v) { return glm::length(v - p) <= rounding * (a + b + glm::length(p)); });
        };
        if (has(r.corner + r.a) && has(r.corner + r.b) && has(r.corner + r.a + r.b)) return r;
    }
    return std::nullopt;
}

}  // namespace neumann
