#include "core/reader/formats/flattened.h"

#include "core/geometry/affine.h"

#include <algorithm>
#include <utility>

namespace neumann::reader {

namespace {

// The matrix of cofactors maps a × b to (m a) × (m b), also if m has no inverse.
glm::dmat3 cofactors(const glm::dmat3& m) { return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])}; }

Vec3 unit(const Vec3& v) {
    const double length = length_of(v);
    return length > 0.0 ? v / length : v;
}

}  // namespace

std::optional<MeshFile> flattened(const MeshFile& file, const Mat4& to_world) {
    MeshFile result{file.mesh, {}};
    auto& at = result.mesh.vertices;
    for (Vec3& v : at) v = transformed_point(to_world, v);
    const auto across = [&](const std::array<std::uint32_t, 3>& t) {
        return glm::cross(unit(at[t[1]] - at[t[0]]), unit(at[t[2]] - at[t[0]]));
    };
    constexpr double least_sine = 1e-12;
    if (std::ranges::none_of(result.mesh.triangles, [&](const auto& t) { return glm::length(across(t)) > least_sine; }))
        return std::nullopt;
    if (file.normals.empty()) return result;
    const glm::dmat3 of_normals = cofactors(scaled_to_one(to_world));
    for (auto& t : result.mesh.triangles)
        if (glm::dot(across(t), of_normals * (file.normals[t[0]] + file.normals[t[1]] + file.normals[t[2]])) < 0.0)
            std::swap(t[1], t[2]);
    return result;
}

}  // namespace neumann::reader
