// C. Loop, Smooth Subdivision Surfaces Based on Triangles, 1987; positions and normals of the limit as Hoppe et al., Piecewise
// Smooth Surface Reconstruction, 1994, and the rules for boundaries as pbrt has them.
#include "core/reader/formats/pbrt/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numbers>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// The neighbours of each vertex, counter-clockwise; those of a vertex on a boundary go from one edge of the boundary to the other.
struct Rings {
    std::vector<std::vector<std::uint32_t>> of;
    std::vector<bool> is_boundary;
};

// The corner of a face at `vertex`, with the neighbours of the vertex along the face's edges, in the order of the face.
struct Corner {
    std::uint32_t vertex, from, to;
    auto operator<=>(const Corner&) const = default;
};

// Throws InputError if the faces around a vertex are not one fan.
Rings rings_of(std::size_t vertex_count, const Triangles& triangles, const Location& place) {
    std::vector<Corner> corners;
    for (const auto& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) corners.push_back({t[i], t[(i + 1) % 3], t[(i + 2) % 3]});
    std::sort(corners.begin(), corners.end());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& c = corners[i];
        if (c.vertex == c.from || (i > 0 && c.vertex == corners[i - 1].vertex && c.from == corners[i - 1].from))
            throw InputError(place,
                             fmt::format("the edge from point {} to point {} is of two faces that run the same way along it, "
                                         "or has no length; expected a surface",
                                         c.vertex, c.from));
    }
    Rings rings{std::vector<std::vector<std::uint32_t>>(vertex_count), std::vector<bool>(vertex_count, false)};
    for (auto first = corners.begin(); first != corners.end();) {
        const std::uint32_t v = first->vertex;
        const auto last = std::find_if(first, corners.end(), [v](const Corner& c) { return c.vertex != v; });
        const auto next = [&](std::uint32_t from) {
            const auto found = std::lower_bound(first, last, Corner{v, from, 0});
            return found != last && found->from == from ? found : last;
        };
        std::vector<std::uint32_t> followers;
        for (auto c = first; c != last; ++c) followers.push_back(c->to);
        std::sort(followers.begin(), followers.end());
        auto at = first;
        for (auto c = first; c != last; ++c)
            if (!std::binary_search(followers.begin(), followers.end(), c->from)) {
                at = c;
                rings.is_boundary[v] = true;
            }
        std::vector<std::uint32_t>& ring = rings.of[v];
        const std::uint32_t start = at->from;
        ring.push_back(start);
        for (; at != last && at->to != start && ring.size() <= followers.size(); at = next(at->to)) ring.push_back(at->to);
        if (ring.size() != followers.size() + (rings.is_boundary[v] ? 1 : 0))
            throw InputError(place, fmt::format("the faces at point {} are not one fan, expected a surface", v));
        first = last;
    }
    return rings;
}

double beta(std::size_t valence) { return valence == 3 ? 3.0 / 16.0 : 3.0 / (8.0 * static_cast<double>(valence)); }
double limit_weight(std::size_t valence) { return 1.0 / (static_cast<double>(valence) + 3.0 / (8.0 * beta(valence))); }

// The weighted mean of a vertex and its neighbours.
Vec3 weighed(const std::vector<Vec3>& p, std::size_t v, const Rings& rings, double of_ring, double of_boundary) {
    const auto& ring = rings.of[v];
    if (rings.is_boundary[v]) return (1.0 - 2.0 * of_boundary) * p[v] + of_boundary * (p[ring.front()] + p[ring.back()]);
    Vec3 sum = (1.0 - static_cast<double>(ring.size()) * of_ring) * p[v];
    for (const std::uint32_t i : ring) sum += of_ring * p[i];
    return sum;
}

void subdivide(std::vector<Vec3>& p, Triangles& triangles, const Location& place) {
    const Rings rings = rings_of(p.size(), triangles, place);
    std::vector<Vec3> moved = p;
    for (std::size_t v = 0; v < p.size(); ++v)
        if (!rings.of[v].empty()) moved[v] = weighed(p, v, rings, beta(rings.of[v].size()), 1.0 / 8.0);
    // The ends of each edge in order, with the opposite corner of one of its faces.
    std::vector<Corner> edges;
    for (const auto& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
            edges.push_back({a, b, t[(i + 2) % 3]});
        }
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<std::uint32_t, 3>> middles;  // the ends of an edge, and the new vertex on it
    for (std::size_t i = 0; i < edges.size();) {
        const auto& [a, b, opposite] = edges[i];
        const bool is_within = i + 1 < edges.size() && edges[i + 1].vertex == a && edges[i + 1].from == b;
        middles.push_back({a, b, static_cast<std::uint32_t>(moved.size())});
        const Vec3 ends = p[a] + p[b];
        moved.push_back(is_within ? 3.0 / 8.0 * ends + 1.0 / 8.0 * (p[opposite] + p[edges[i + 1].to]) : 0.5 * ends);
        i += is_within ? 2 : 1;
    }
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
        const auto [a, b] = std::minmax(i, j);
        return (*std::lower_bound(middles.begin(), middles.end(), std::array<std::uint32_t, 3>{a, b, 0}))[2];
    };
    Triangles finer;
    for (const auto& t : triangles) {
        std::array<std::uint32_t, 3> m{};
        for (std::size_t i = 0; i < 3; ++i) m[i] = middle(t[i], t[(i + 1) % 3]);
        for (std::size_t i = 0; i < 3; ++i) finer.push_back({t[i], m[i], m[(i + 2) % 3]});
        finer.push_back(m);
    }
    p = std::move(moved);
    triangles = std::move(finer);
}

// The cross product of two tangents of the limit surface.
Vec3 limit_normal(const std::vector<Vec3>& p, std::size_t v, const Rings& rings) {
    const auto& ring = rings.of[v];
    const std::size_t n = ring.size();
    Vec3 s(0.0), t(0.0);
    if (!rings.is_boundary[v]) {
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
            s += std::cos(angle) * p[ring[i]];
            t += std::sin(angle) * p[ring[i]];
        }
        return glm::cross(s, t);
    }
    s = p[ring.front()] - p[ring.back()];
    if (n == 2) {
        t = p[ring[0]] + p[ring[1]] - 2.0 * p[v];
    } else if (n == 3) {
        t = p[ring[1]] - p[v];
    } else if (n == 4) {
        t = -p[ring[0]] + 2.0 * p[ring[1]] + 2.0 * p[ring[2]] - p[ring[3]] - 2.0 * p[v];
    } else {
        const double theta = std::numbers::pi / static_cast<double>(n - 1);
        t = std::sin(theta) * (p[ring.front()] + p[ring.back()]);
        for (std::size_t i = 1; i + 1 < n; ++i)
            t += (2.0 * std::cos(theta) - 2.0) * std::sin(static_cast<double>(i) * theta) * p[ring[i]];
        t = -t;
    }
    return glm::cross(s, t);
}

}  // namespace

MadeMesh make_loop_surface(Parameters& p) {
    std::vector<Vec3> points = p.triples("P", {"point3"});
    const std::int64_t levels = p.integer("levels").value_or(3);
    if (points.empty()) p.complain("P", fmt::format("{} has no \"point3 P\"", p.title()));
    constexpr std::int64_t max_levels = 10;
    if (levels < 0 || levels > max_levels)
        p.complain("levels", fmt::format("levels of {} is {}, expected from 0 to {}", p.title(), levels, max_levels));
    p.ignore({"scheme"});
    const std::vector<std::uint32_t> indices = read_indices(p, points.size(), 3);
    Triangles triangles;
    for (std::size_t i = 0; i < indices.size(); i += 3) triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    constexpr std::size_t max_triangles = std::size_t(1) << 22;
    if (triangles.size() << (2 * levels) > max_triangles)
        throw InputError(p.place(), fmt::format("{} has {} triangles after {} levels, expected at most {}", p.title(),
                                                triangles.size() << (2 * levels), levels, max_triangles));
    for (std::int64_t i = 0; i < levels; ++i) subdivide(points, triangles, p.place());

    const Rings rings = rings_of(points.size(), triangles, p.place());
    MadeMesh result;
    result.file.mesh.vertices = points;
    for (std::size_t v = 0; v < points.size(); ++v)
        if (!rings.of[v].empty())
            result.file.mesh.vertices[v] = weighed(points, v, rings, limit_weight(rings.of[v].size()), 1.0 / 5.0);
    for (std::size_t v = 0; v < points.size(); ++v)
        result.file.normals.push_back(rings.of[v].empty() ? Vec3(0.0) : limit_normal(result.file.mesh.vertices, v, rings));
    result.file.mesh.triangles = std::move(triangles);
    return result;
}

}  // namespace neumann::reader::pbrt
