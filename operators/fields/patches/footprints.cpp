#include "operators/fields/patches/footprints.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace neumann {

namespace {

// Limit on the pairs of charts and edges that are tested; in larger scenes patches are small anyway.
constexpr std::size_t most_pairs = 20'000'000;

// Bands reach depth_of_bands widths into a gap; if that is less than `near`, there are none. They end where they would be as wide
// as the patches. The band at the mouth is a quarter as wide as the gap. The light that leaks out is then right to 2%; without
// bands it is 17% too much (tests/matrix/gaps.cpp).
constexpr double depth_of_bands = 16.0, largest_depth = 12.0, band_ratio = 0.8;

struct Edge {
    Vec3 a, b;
    std::uint32_t shape;
    std::vector<std::size_t> charts;  // the charts that have this edge
};

std::array<double, 6> key(const Vec3& a, const Vec3& b) {
    const std::array x{a.x, a.y, a.z}, y{b.x, b.y, b.z};
    const auto& [low, high] = std::minmax(x, y);
    return {low[0], low[1], low[2], high[0], high[1], high[2]};
}

// The edges of quadrilaterals, except edges between two quadrilaterals in one plane.
std::vector<Edge> outline_edges(const std::vector<Chart>& charts) {
    struct Side {
        Edge edge;
        Vec3 normal;
        bool inner = false;
    };
    std::map<std::pair<std::uint32_t, std::array<double, 6>>, Side> sides;
    for (std::size_t number = 0; number < charts.size(); ++number) {
        const Chart& chart = charts[number];
        if (!chart.is_plane()) continue;
        const auto corners = chart.corners();
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 a = corners[i], b = corners[(i + 1) % 4];
            if (a == b) continue;
            const auto [found, is_new] =
                sides.try_emplace({chart.shape(), key(a, b)}, Side{{a, b, chart.shape(), {}}, chart.normal()});
            found->second.edge.charts.push_back(number);
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

// Whether a point in the plane of the quadrilateral lies inside it.
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

double distance(const Vec3& p, const Footprints::Mouth& m) {
    const Vec3 along = m.b - m.a;
    const double u = std::clamp(glm::dot(p - m.a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(p, m.a + u * along);
}

// The width of the gap between a chart and an edge whose ends are at heights a and b above it; 0 if the edge touches or crosses the
// chart's plane, or if one height is less than half of the other.
double gap_width(double a, double b) {
    const double low = std::min(std::abs(a), std::abs(b)), high = std::max(std::abs(a), std::abs(b));
    return a * b > 0.0 && low > 0.5 * high ? high : 0.0;
}

}  // namespace

Region Footprints::region(const Vec2& st, const Vec3& position) const {
    Region region;
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        bool inside = false;
        for (const Segment& segment : outlines_[i]) {
            if ((segment.a.y > st.y) == (segment.b.y > st.y)) continue;
            const double x = segment.a.x + (segment.b.x - segment.a.x) * (st.y - segment.a.y) / (segment.b.y - segment.a.y);
            if (x > st.x) inside = !inside;
        }
        if (inside) region.shapes |= 1u << i;
    }
    double nearest = 1.0;
    for (const Mouth& mouth : mouths_) nearest = std::min(nearest, distance(position, mouth) / mouth.depth);
    if (nearest < 1.0) {
        static const double per_band = 1.0 / std::log(band_ratio);
        region.band = static_cast<std::uint32_t>(std::min(1.0 + std::log(std::max(nearest, 1e-9)) * per_band, double{bands}));
    }
    return region;
}

bool Footprints::divides(const Cell& cell) const {
    const auto overlap = [](double a, double b, double low, double high) {
        return std::min(a, b) <= high && std::max(a, b) >= low;
    };
    for (const auto& outline : outlines_)
        for (const Segment& s : outline)
            if (overlap(s.a.x, s.b.x, cell.s0, cell.s1) && overlap(s.a.y, s.b.y, cell.t0, cell.t1)) return true;
    return false;
}

bool Footprints::has_bands(const Vec3& position, double d) const {
    return std::any_of(mouths_.begin(), mouths_.end(),
                       [&](const Mouth& mouth) { return distance(position, mouth) < mouth.depth + d; });
}

std::vector<Footprints> find_footprints(const Geometry& geometry, const std::vector<Chart>& charts, double near) {
    std::vector<Footprints> result(charts.size());
    const std::vector<Edge> edges = outline_edges(charts);
    if (charts.size() * edges.size() > most_pairs) return result;
    const auto is_larger_than_bands = [&](const Chart& chart) {
        return std::min(chart.lengths().x, chart.lengths().y) > 2.0 * near;
    };
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const Chart& chart = charts[i];
        if (!chart.is_plane()) continue;
        const Vec3 origin = chart.corners()[0], normal = chart.normal();
        const auto height = [&](const Vec3& p) { return glm::dot(p - origin, normal); };
        struct Outline {
            std::vector<Footprints::Segment> segments;
            bool divides = false;  // the outline divides the chart: neither all inside nor all outside
        };
        std::map<std::uint32_t, Outline> outlines;  // by shape
        for (const Edge& edge : edges) {
            if (std::max(std::abs(height(edge.a)), std::abs(height(edge.b))) > near) continue;
            const Vec3 a = edge.a - normal * height(edge.a), b = edge.b - normal * height(edge.b);
            Outline& outline = outlines[edge.shape];
            outline.segments.push_back({chart.coordinates(geometry, a), chart.coordinates(geometry, b)});
            // Edges that start at a corner of the chart belong to adjacent surfaces.
            if (is_corner(chart, edge.a) || is_corner(chart, edge.b)) continue;
            bool above = false;
            for (const Vec3& p : {a, 0.5 * (a + b), b}) above = above || is_inside(chart, p);
            outline.divides = outline.divides || above;
            const double gap = gap_width(height(edge.a), height(edge.b));
            if (!above || depth_of_bands * gap < near || !is_larger_than_bands(chart)) continue;
            const double depth = std::min(depth_of_bands * gap, largest_depth * near);
            result[i].add(Footprints::Mouth{a, b, depth});
            for (const std::size_t own : edge.charts)
                if (is_larger_than_bands(charts[own])) result[own].add(Footprints::Mouth{edge.a, edge.b, depth});
        }
        for (auto& [shape, outline] : outlines)
            if (outline.divides) result[i].add(std::move(outline.segments));
    }
    return result;
}

}  // namespace neumann
