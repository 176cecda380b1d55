#include "operators/experiments/known/scene_maker.h"

#include "core/base/frame.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <map>
#include <utility>

namespace neumann::known {

std::uint32_t SceneMaker::add(Shape shape, const Surface& surface) {
    Materials::Sides sides;
    if (surface.reflectance || surface.bsdf) {
        sides.front = static_cast<int>(parts.bsdfs.size());
        if (surface.two_sided) sides.back = sides.front;
        parts.bsdfs.push_back(surface.bsdf ? *surface.bsdf : Diffuse(*surface.reflectance));
    }
    if (surface.back) {
        sides.back = static_cast<int>(parts.bsdfs.size());
        parts.bsdfs.push_back(*surface.back);
    }
    parts.sides_of_shape.push_back(sides);
    parts.lights.of_shape.push_back(surface.emission ? static_cast<int>(parts.lights.area.size()) : Emitters::none);
    if (surface.emission) parts.lights.area.push_back(*surface.emission);
    parts.shapes.push_back(std::move(shape));
    return static_cast<std::uint32_t>(parts.shapes.size() - 1);
}

TriangleMesh parallelogram(const Vec3& corner, const Vec3& a, const Vec3& b) { return strips(corner, a, b, 1); }

TriangleMesh strips(const Vec3& corner, const Vec3& a, const Vec3& b, int count) {
    TriangleMesh mesh;
    for (int i = 0; i <= count; ++i) {
        const Vec3 low = corner + a * (static_cast<double>(i) / count);
        mesh.vertices.push_back(low);
        mesh.vertices.push_back(low + b);
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        const std::uint32_t k = 2 * i;
        mesh.triangles.push_back({k, k + 2, k + 3});
        mesh.triangles.push_back({k, k + 3, k + 1});
    }
    return mesh;
}

TriangleMesh patch(const Vec3& center, const Vec3& normal, double half_side) {
    const Frame frame(normal);
    return parallelogram(center - (frame.s + frame.t) * half_side, frame.s * (2.0 * half_side), frame.t * (2.0 * half_side));
}

TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

std::array<TriangleMesh, 6> room(const Vec3& low, const Vec3& high) {
    const Vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    return {parallelogram(low, y, z),     parallelogram(low + x, z, y), parallelogram(low, z, x),
            parallelogram(low + y, x, z), parallelogram(low, x, y),     parallelogram(low + z, y, x)};
}

TriangleMesh box(const Vec3& low, const Vec3& high) {
    TriangleMesh mesh;
    for (const TriangleMesh& face : room(low, high)) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), face.vertices.begin(), face.vertices.end());
        for (const auto& t : face.triangles) mesh.triangles.push_back({first + t[0], first + t[2], first + t[1]});
    }
    return mesh;
}

TriangleMesh tetrahedron(double size) {
    return {{Vec3(1, 1, 1) * size, Vec3(1, -1, -1) * size, Vec3(-1, 1, -1) * size, Vec3(-1, -1, 1) * size},
            {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

TriangleMesh icosphere(int level) {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    TriangleMesh mesh{
        {{-1, g, 0},
         {1, g, 0},
         {-1, -g, 0},
         {1, -g, 0},
         {0, -1, g},
         {0, 1, g},
         {0, -1, -g},
         {0, 1, -g},
         {g, 0, -1},
         {g, 0, 1},
         {-g, 0, -1},
         {-g, 0, 1}},
        {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
         {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    for (Vec3& v : mesh.vertices) v = glm::normalize(v);
    for (int l = 0; l < level; ++l) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] = known.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(glm::normalize(mesh.vertices[a] + mesh.vertices[b]));
            return found->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

TriangleMesh prism(int n) {
    TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}};
    const auto corners = static_cast<std::uint32_t>(n);
    for (int i = 0; i < n; ++i) {
        const double phi = 2.0 * pi * i / n;
        mesh.vertices.push_back({std::cos(phi), std::sin(phi), 0});
        mesh.vertices.push_back({std::cos(phi), std::sin(phi), 1});
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t low = 2 + 2 * i, next = 2 + 2 * ((i + 1) % corners);
        mesh.triangles.insert(mesh.triangles.end(),
                              {{0, next, low}, {1, low + 1, next + 1}, {low, next, next + 1}, {low, next + 1, low + 1}});
    }
    return mesh;
}

TriangleMesh flipped(TriangleMesh mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

}  // namespace neumann::known
