#include "core/reader/formats/pbrt/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

constexpr std::uint32_t cuts = 16;

// Interpolates between corners in pbrt's order: (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
template <class T>
T bilinear(const std::array<T, 4>& c, double u, double v) {
    return (1.0 - v) * ((1.0 - u) * c[0] + u * c[1]) + v * ((1.0 - u) * c[2] + u * c[3]);
}

template <class T>
std::array<T, 4> corners(const std::vector<T>& values, const std::vector<std::uint32_t>& indices, std::size_t patch) {
    return {values[indices[4 * patch]], values[indices[4 * patch + 1]], values[indices[4 * patch + 2]],
            values[indices[4 * patch + 3]]};
}

// Whether the patch is a parallelogram: its two triangles are the patch, and values at the corners are linear on them.
bool is_parallelogram(const std::array<Vec3, 4>& c) {
    const double size = std::max({length_of(c[1] - c[0]), length_of(c[2] - c[0]), length_of(c[3] - c[0])});
    return length_of(c[0] + c[3] - c[1] - c[2]) <= 1e-6 * size;
}

// Whether the patch is a convex flat quadrangle, of which the two triangles are the same surface.
bool is_flat_and_convex(const std::array<Vec3, 4>& c) {
    const std::array<Vec3, 4> around = {c[0], c[1], c[3], c[2]};
    const Vec3 n = glm::cross(c[3] - c[0], c[2] - c[1]);
    const double size = std::max(length_of(c[3] - c[0]), length_of(c[2] - c[1])), area = length_of(n);
    if (!(area > 0.0) || std::abs(glm::dot(c[1] - c[0], n / area)) > 1e-6 * size) return false;
    for (std::size_t i = 0; i < 4; ++i)
        if (!(glm::dot(glm::cross(around[(i + 1) % 4] - around[i], around[(i + 2) % 4] - around[(i + 1) % 4]), n) > 0.0))
            return false;
    return true;
}

}  // namespace

MadeMesh make_bilinear_mesh(Parameters& p, Importer& importer) {
    const std::vector<Vec3> points = p.triples("P", {"point3"}), normals = p.triples("N", {"normal"});
    const std::vector<Vec2> uv = p.pairs("uv");
    if (points.empty()) p.complain("P", fmt::format("{} has no \"point3 P\"", p.title()));
    for (const auto& [name, count] : {std::pair("N", normals.size()), std::pair("uv", uv.size())})
        if (count != 0 && count != points.size())
            p.complain(name, fmt::format("{} of {} has {} values, expected {}, as P has", name, p.title(), count, points.size()));
    if (p.has("emissionfilename"))
        p.refuse("emissionfilename", fmt::format("emissionfilename of {} is not supported", p.title()),
                 "; filename of the area light is");
    p.ignore({"faceIndices"});
    const std::vector<std::uint32_t> indices = read_indices(p, points.size(), 4);

    const std::size_t count = indices.size() / 4;
    bool flat = true, linear = normals.empty();
    for (std::size_t i = 0; i < count; ++i) {
        const auto c = corners(points, indices, i);
        linear = linear && is_parallelogram(c);
        flat = flat && (is_parallelogram(c) || is_flat_and_convex(c));
    }
    // What varies over a patch is linear in its triangles only if they make a parallelogram.
    const std::uint32_t n = linear ? 1 : cuts;
    if (!flat) importer.warnings.add("bilinearmesh: a patch that is not flat is cut into 16 × 16 pairs of triangles");
    constexpr std::size_t max_triangles = std::size_t(1) << 26;
    if (count * 2 * n * n > max_triangles)
        throw InputError(p.place(), fmt::format("{} patches of {} are cut into {} triangles each, more than {} together", count,
                                                p.title(), 2 * n * n, max_triangles));

    MadeMesh result;
    result.triangles_of_light = 2 * n * n;
    for (std::size_t i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(result.file.mesh.vertices.size());
        for (std::uint32_t y = 0; y <= n; ++y)
            for (std::uint32_t x = 0; x <= n; ++x) {
                const double u = double(x) / n, v = double(y) / n;
                result.file.mesh.vertices.push_back(bilinear(corners(points, indices, i), u, v));
                if (!normals.empty()) result.file.normals.push_back(bilinear(corners(normals, indices, i), u, v));
                result.file.mesh.uv.push_back(uv.empty() ? Vec2(u, v) : bilinear(corners(uv, indices, i), u, v));
            }
        for (std::uint32_t y = 0; y < n; ++y)
            for (std::uint32_t x = 0; x < n; ++x) {
                const std::uint32_t a = first + y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
                result.file.mesh.triangles.push_back({a, b, d});
                result.file.mesh.triangles.push_back({a, d, c});
            }
    }
    return result;
}

}  // namespace neumann::reader::pbrt
