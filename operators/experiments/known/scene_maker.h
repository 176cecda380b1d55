// Makes scenes by code.
#pragma once

#include "core/geometry/transformed.h"
#include "core/scene/scene.h"

#include <array>
#include <optional>

namespace neumann::known {

inline Rgb grey(double x) { return Rgb(x); }

// The front of a surface. The back is black, unless `two_sided` or `back` is set.
struct Surface {
    std::optional<SurfaceFunction> reflectance;
    std::optional<AreaLight> emission;
    bool two_sided = false;
    std::optional<Bsdf> bsdf = std::nullopt;  // in place of the reflectance
    std::optional<Bsdf> back = std::nullopt;  // the material of the back
};
inline Surface black() { return {}; }
inline Surface matte(double rho) { return {grey(rho), std::nullopt}; }
inline Surface lamp(double radiance) { return {std::nullopt, grey(radiance)}; }
inline Surface made_of(Bsdf bsdf, std::optional<AreaLight> emission = std::nullopt) {
    return {std::nullopt, std::move(emission), false, std::move(bsdf)};
}
inline Surface boundary(Bsdf front, Bsdf back) { return {std::nullopt, std::nullopt, false, std::move(front), std::move(back)}; }
inline Surface glowing(double rho, double radiance) { return {grey(rho), grey(radiance)}; }

class SceneMaker {
public:
    std::uint32_t add(Shape shape, const Surface& surface);
    template <std::size_t n>
    std::array<std::uint32_t, n> add(const std::array<TriangleMesh, n>& meshes, const Surface& surface) {
        std::array<std::uint32_t, n> numbers;
        for (std::size_t i = 0; i < n; ++i) numbers[i] = add(meshes[i], surface);
        return numbers;
    }
    Scene make() const { return make_scene(parts); }

    SceneParts parts;
};

// corner + s a + t b, s and t in [0, 1]; the front side is that of a × b.
TriangleMesh parallelogram(const Vec3& corner, const Vec3& a, const Vec3& b);
// The same parallelogram, cut into strips across a.
TriangleMesh strips(const Vec3& corner, const Vec3& a, const Vec3& b, int count);
// A small square that faces along `normal`.
TriangleMesh patch(const Vec3& center, const Vec3& normal, double half_side);
TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c);
// The order of the faces of room().
enum Face : std::size_t { left, right, front, back, floor, ceiling };
// The six faces of the box seen from inside: x low and high, y low and high, z low and high.
std::array<TriangleMesh, 6> room(const Vec3& low, const Vec3& high);
// The faces of a box, facing outwards.
TriangleMesh box(const Vec3& low, const Vec3& high);
TriangleMesh tetrahedron(double size);
// 20 · 4^level triangles with their vertices on the unit sphere; faces outwards.
TriangleMesh icosphere(int level);
// A prism of height 1 above the regular n-gon of radius 1: its ends are fans of n triangles, its sides 2 n needles.
TriangleMesh prism(int n);

TriangleMesh flipped(TriangleMesh mesh);
// The triangles whose centroids `take` accepts.
template <class Predicate>
TriangleMesh part(const TriangleMesh& mesh, Predicate take) {
    TriangleMesh result{mesh.vertices, {}};
    for (const auto& t : mesh.triangles)
        if (take((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0)) result.triangles.push_back(t);
    return result;
}

}  // namespace neumann::known
