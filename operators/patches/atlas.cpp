#include "operators/patches/atlas.h"

#include <algorithm>
#include <array>
#include <map>

namespace neumann {

namespace {

struct Corners {
    Vec3 a, b, c;
    Corners(const TriangleMesh& mesh, std::size_t i)
        : a(mesh.vertices[mesh.triangles[i][0]]), b(mesh.vertices[mesh.triangles[i][1]]), c(mesh.vertices[mesh.triangles[i][2]]) {}
    Vec3 across() const { return glm::cross(b - a, c - a); }
};

bool before(const Vec3& x, const Vec3& y) { return std::array{x.x, x.y, x.z} < std::array{y.x, y.y, y.z}; }

// An edge, identified by the positions of its ends, because files often repeat vertices.
using EdgeEnds = std::array<double, 6>;
EdgeEnds edge_between(Vec3 x, Vec3 y) {
    if (before(y, x)) std::swap(x, y);
    return {x.x, x.y, x.z, y.x, y.y, y.z};
}

// Tolerance for plane quadrilaterals, relative to their size: coordinates in files have few digits.
constexpr double plane_tolerance = 1e-6;

// Whether all corners of a b c d turn left about the normal, and none is collinear with its neighbours.
bool is_plane_and_convex(const std::array<Vec3, 4>& p, const Vec3& normal) {
    for (int i = 0; i < 4; ++i) {
        const Vec3 in = p[i] - p[(i + 3) % 4], out = p[(i + 1) % 4] - p[i];
        if (glm::dot(glm::cross(in, out), normal) < 1e-3 * glm::length(in) * glm::length(out)) return false;
        if (std::abs(glm::dot(out, normal)) > plane_tolerance * glm::length(out)) return false;
    }
    return true;
}

}  // namespace

Atlas::Atlas(const Geometry& geometry, double patch_area) {
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
        first_of_shape_.push_back(primitives_.size());
        primitives_.resize(primitives_.size() + geometry.primitive_count(shape));
        if (const auto* mesh = std::get_if<TriangleMesh>(&geometry.shapes()[shape])) {
            add_mesh(shape, *mesh, patch_area);
        } else if (geometry.area(shape) > 0.0) {
            primitives_.back().chart = static_cast<std::uint32_t>(charts_.size());
            charts_.emplace_back(geometry, shape);
        }
    }
}

void Atlas::add_mesh(std::uint32_t shape, const TriangleMesh& mesh, double patch_area) {
    std::vector<bool> has_chart(mesh.triangles.size());
    add_pairs(shape, mesh, has_chart);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (has_chart[i]) continue;
        const Corners t(mesh, i);
        const double twice = glm::length(t.across());
        const Vec3 normal = t.across() / twice;
        const auto number = static_cast<std::uint32_t>(i);
        Primitive& primitive = primitives_[first_of_shape_[shape] + i];
        primitive.chart = static_cast<std::uint32_t>(charts_.size());
        if (0.5 * twice <= patch_area) {
            charts_.emplace_back(shape, std::array{t.a, t.b, t.c, t.c}, normal, number, number);
            continue;
        }
        const Vec3 middle = (t.a + t.b + t.c) / 3.0, ab = 0.5 * (t.a + t.b), bc = 0.5 * (t.b + t.c), ca = 0.5 * (t.c + t.a);
        charts_.emplace_back(shape, std::array{t.a, ab, middle, ca}, normal, number, number);
        charts_.emplace_back(shape, std::array{t.b, bc, middle, ab}, normal, number, number);
        charts_.emplace_back(shape, std::array{t.c, ca, middle, bc}, normal, number, number);
        cut_.emplace_back(t.a, t.b, t.c, 0.0);
        primitive.cut = static_cast<std::uint32_t>(cut_.size());
    }
}

void Atlas::add_pairs(std::uint32_t shape, const TriangleMesh& mesh, std::vector<bool>& has_chart) {
    // The longest shared edges come first: these are the diagonals of rectangles.
    std::map<EdgeEnds, std::vector<std::uint32_t>> at_edge;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Corners t(mesh, i);
        for (const auto& [x, y] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
            at_edge[edge_between(x, y)].push_back(i);
    }
    struct Shared {
        double length;
        std::uint32_t first, second;
    };
    std::vector<Shared> shared;
    for (const auto& [e, triangles] : at_edge)
        if (triangles.size() == 2)
            shared.push_back({glm::distance(Vec3(e[0], e[1], e[2]), Vec3(e[3], e[4], e[5])), triangles[0], triangles[1]});
    std::stable_sort(shared.begin(), shared.end(), [](const Shared& x, const Shared& y) { return x.length > y.length; });

    for (const Shared& pair : shared) {
        if (has_chart[pair.first] || has_chart[pair.second]) continue;
        // Rotated so that the triangles are a b c and a c d, which share the edge a c.
        const Corners lower(mesh, pair.first), upper(mesh, pair.second);
        const std::array low{lower.a, lower.b, lower.c}, up{upper.a, upper.b, upper.c};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const Vec3 a = low[i], b = low[(i + 1) % 3], c = low[(i + 2) % 3];
                if (has_chart[pair.first] || up[j] != a || up[(j + 1) % 3] != c) continue;
                const std::array quad{a, b, c, up[(j + 2) % 3]};
                const Vec3 normal = glm::normalize(lower.across());
                if (!is_plane_and_convex(quad, normal)) continue;
                for (const std::uint32_t triangle : {pair.first, pair.second}) {
                    has_chart[triangle] = true;
                    primitives_[first_of_shape_[shape] + triangle].chart = static_cast<std::uint32_t>(charts_.size());
                }
                charts_.emplace_back(shape, quad, normal, pair.first, pair.second);
            }
    }
}

std::uint32_t Atlas::nearest_corner(const Primitive& primitive, const Vec3& position) const {
    const Vec2 w = cut_[primitive.cut - 1].weights(position);
    const double first = 1.0 - w.x - w.y;
    return first >= w.x ? (first >= w.y ? 0 : 2) : (w.x >= w.y ? 1 : 2);
}

}  // namespace neumann
