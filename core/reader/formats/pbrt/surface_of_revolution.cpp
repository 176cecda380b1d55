#include "core/reader/formats/pbrt/meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neumann::reader::pbrt {

namespace {

constexpr double cuts_of_a_turn = 256.0;

}  // namespace

std::uint32_t cuts_of(double angle) {
    return std::max(1u, static_cast<std::uint32_t>(std::ceil(angle / (2.0 * std::numbers::pi) * cuts_of_a_turn - 1e-9)));
}

MadeMesh make_surface_of_revolution(const std::function<Profile(double v)>& profile, std::uint32_t rows, double phi_max) {
    const std::uint32_t columns = cuts_of(phi_max);
    MadeMesh result;
    TriangleMesh& mesh = result.file.mesh;
    for (std::uint32_t y = 0; y <= rows; ++y)
        for (std::uint32_t x = 0; x <= columns; ++x) {
            const Vec2 uv(double(x) / columns, double(y) / rows);
            const Profile at = profile(uv.y);
            const double c = std::cos(uv.x * phi_max), s = std::sin(uv.x * phi_max);
            mesh.vertices.push_back({at.point.x * c, at.point.x * s, at.point.y});
            result.file.normals.push_back({at.normal.x * c, at.normal.x * s, at.normal.y});
            mesh.uv.push_back(uv);
        }
    const auto is_on_axis = [&](std::uint32_t y) { return profile(double(y) / rows).point.x == 0.0; };
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            if (!is_on_axis(y)) mesh.triangles.push_back({a, b, d});
            if (!is_on_axis(y + 1)) mesh.triangles.push_back({a, d, c});
        }
    return result;
}

}  // namespace neumann::reader::pbrt
