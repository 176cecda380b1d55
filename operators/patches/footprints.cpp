#include "operators/patches/footprints.h"

#include <algorithm>
#include <array>

namespace neumann {

namespace {

// Pairs of charts and edges that are looked at; in larger scenes patches are small anyway.
constexpr std::size_t most_pairs = 20'000'000;

struct Edge {
    Vec3 a, b;
    std::uint32_t shape;
};

std::array<double, 6> key(const Vec3& a, const Vec3& b) {
    const std::array x{a.x, a.y, a.z}, y{b.x, b.y, b.z};
    const auto& [low, high] = std::minmax(x, y);
    return {low[0], low[1], low[2], high[0], high[1], high[2]};
}

// Sides of quadrilaterals, without those between two that lie in one plane.
std::vector<Edge> outline_edges(const std::vector<Chart>& charts) {
    struct Side {
        Edge edge;
        Vec3 normal;
        bool inner = false;
    };
    std::map<std::pair<std::uint32_t, std::array<double, 6>>, Side> sides;
    for (const Chart& chart : charts) {
        if (!chart.is_plane()) continue;
        const auto corners = chart.corners();
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 a = corners[i], b = corners[(i + 1) % 4];
            if (a == b) continue;
            const auto [found, is_new] = sides.try_emplace({chart.shape(), key(a, b)}, Side{{a, b, chart.shape()}, chart.normal()});
            if (!is_new && glm::dot(found->second.normal, chart.normal()) > 1.0 - 1e-6) found->second.inner = true;
        }
    }
    std::vector<Edge> edges;
    for (const auto& [name, side] : sides)
        if (!side.inner) edges.push_back(side.edge);
    return edges;
}

bool is_corner(const Chart& chart, const Vec3& p) {
    const auto& corners = chart.corners();
    return std::find(corners.begin(), corners.end(), p) != corners.end();
}

// Of the quadrilateral, for a point in its plane.
bool is_inside(const Chart& chart, const Vec3& p) {
    const auto& corners = chart.corners();
    const double size = glm::distance(corners[0], corners[2]);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 along = corners[(i + 1) % 4] - corners[i];
        if (along == Vec3(0.0)) continue;
        if (glm::dot(glm::cross(along, p - corners[i]), chart.normal()) <= 1e-6 * glm::length(along) * size) return false;
    }
    return true;
}

}  // namespace

std::uint32_t Footprints::classes(const Vec2& p) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        bool inside = false;
        for (const Segment& segment : outlines_[i]) {
            if ((segment.a.y > p.y) == (segment.b.y > p.y)) continue;
            const double x = segment.a.x + (segment.b.x - segment.a.x) * (p.y - segment.a.y) / (segment.b.y - segment.a.y);
            if (x > p.x) inside = !inside;
        }
        if (inside) bits |= 1u << i;
    }
    return bits;
}

std::vector<Footprints> find_footprints(const Geometry& geometry, const std::vector<Chart>& charts, double near) {
    std::vector<Footprints> result(charts.size());
    const std::vector<Edge> edges = outline_edges(charts);
    if (charts.size() * edges.size() > most_pairs) return result;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const Chart& chart = charts[i];
        if (!chart.is_plane()) continue;
        const Vec3 origin = chart.corners()[0], normal = chart.normal();
        const auto height = [&](const Vec3& p) { return glm::dot(p - origin, normal); };
        struct Outline {
            std::vector<Footprints::Segment> segments;
            bool divides = false;  // the chart: not all of it is inside, or outside
        };
        std::map<std::uint32_t, Outline> outlines;  // by shape
        for (const Edge& edge : edges) {
            if (std::max(std::abs(height(edge.a)), std::abs(height(edge.b))) > near) continue;
            const Vec3 a = edge.a - normal * height(edge.a), b = edge.b - normal * height(edge.b);
            Outline& outline = outlines[edge.shape];
            outline.segments.push_back({chart.coordinates(geometry, a), chart.coordinates(geometry, b)});
            // Surfaces that go on from the chart's edge do not stand on it.
            if (is_corner(chart, edge.a) || is_corner(chart, edge.b)) continue;
            for (const Vec3& p : {a, 0.5 * (a + b), b}) outline.divides = outline.divides || is_inside(chart, p);
        }
        for (auto& [shape, outline] : outlines)
            if (outline.divides) result[i].add(std::move(outline.segments));
    }
    return result;
}

}  // namespace neumann
