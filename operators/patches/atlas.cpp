#include "operators/patches/atlas.h"

#include <algorithm>
#include <array>
#include <map>

namespace neumann {

namespace {

Vec3 across(const std::array<Vec3, 3>& corners) { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }

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
        const auto number = static_cast<std::uint32_t>(i);
        const std::array<Vec3, 3> corners = corners_of(mesh, number).at;
        const auto& [a, b, c] = corners;
        const double twice = glm::length(across(corners));
        const Vec3 normal = across(corners) / twice;
        Primitive& primitive = primitives_[first_of_shape_[shape] + i];
        primitive.chart = static_cast<std::uint32_t>(charts_.size());
        if (0.5 * twice <= patch_area) {
            charts_.emplace_back(shape, std::array{a, b, c, c}, normal, number, number);
            continue;
        }
        const Vec3 middle = (a + b + c) / 3.0, ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        charts_.emplace_back(shape, std::array{a, ab, middle, ca}, normal, number, number);
        charts_.emplace_back(shape, std::array{b, bc, middle, ab}, normal, number, number);
        charts_.emplace_back(shape, std::array{c, ca, middle, bc}, normal, number, number);
        cut_.emplace_back(a, b, c, 0.0);
        primitive.cut = static_cast<std::uint32_t>(cut_.size());
    }
}

void Atlas::add_pairs(std::uint32_t shape, const TriangleMesh& mesh, std::vector<bool>& has_chart) {
    // The longest shared edges come first: these are the diagonals of rectangles.
    std::map<EdgeEnds, std::vector<std::uint32_t>> at_edge;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = corners_of(mesh, i).at;
        for (const auto& [x, y] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) at_edge[edge_between(x, y)].push_back(i);
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
        const std::array<Vec3, 3> low = corners_of(mesh, pair.first).at, up = corners_of(mesh, pair.second).at;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const Vec3 a = low[i], b = low[(i + 1) % 3], c = low[(i + 2) % 3];
                if (has_chart[pair.first] || up[j] != a || up[(j + 1) % 3] != c) continue;
                const std::array quad{a, b, c, up[(j + 2) % 3]};
                const Vec3 normal = glm::normalize(across(low));
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
