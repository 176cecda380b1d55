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
        std::map<std::uint32_t, std::vector<Footprints::Segment>> outlines;  // by shape
        for (const Edge& edge : edges) {
            if (std::max(std::abs(height(edge.a)), std::abs(height(edge.b))) > near) continue;
            const auto place = [&](const Vec3& p) { return chart.coordinates(geometry, p - normal * height(p)); };
            outlines[edge.shape].push_back({place(edge.a), place(edge.b)});
        }
        for (auto& [shape, outline] : outlines) {
            // Only what divides the chart: somewhere inside and somewhere not.
            const bool crosses = std::any_of(outline.begin(), outline.end(), [](const Footprints::Segment& s) {
                const auto within = [](double x) { return x > 1e-6 && x < 1.0 - 1e-6; };
                const Vec2 middle = 0.5 * (s.a + s.b);
                return (within(s.a.x) && within(s.a.y)) || (within(s.b.x) && within(s.b.y)) ||
                       (within(middle.x) && within(middle.y));
            });
            if (crosses) result[i].add(std::move(outline));
        }
    }
    return result;
}

}  // namespace neumann
