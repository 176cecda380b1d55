// Outlines of surfaces that touch a chart, or come closer to it than the width of a patch: they are projected onto the
// chart and divide it (discontinuity meshing). The radiance jumps across such a line (the floor under a box, the
// ceiling above a lamp), so patches do not reach across it and fields are not interpolated across it.
//
// Light in a narrow gap is reflected to and fro many times and moves on by about the gap's width each time. The light that leaks
// out therefore comes from a depth of a few widths, and larger patches would mix it with light that stays inside. Along the mouth
// of a gap both surfaces are divided into bands, each a fifth narrower than the next one inwards.
#pragma once

#include "operators/fields/patches/chart.h"

#include <map>
#include <vector>

namespace neumann {

// The region between the outlines on a chart in which a point lies.
struct Region {
    std::uint32_t shapes = 0;  // one bit per outline: whether the point lies inside
    std::uint32_t band = 0;    // 0: far from gaps
    auto operator<=>(const Region&) const = default;
};

class Footprints {
public:
    static constexpr std::size_t most_shapes = 16;
    static constexpr std::uint32_t bands = 19;

    struct Segment {
        Vec2 a, b;  // (s, t) of the chart
    };
    struct Mouth {
        Vec3 a, b;     // a line in the chart's plane
        double depth;  // the bands reach this far into the gap
    };
    // Adds the outline of one more shape. The caller must leave out outlines that are not closed.
    void add(std::vector<Segment> outline) {
        if (outlines_.size() < most_shapes) outlines_.push_back(std::move(outline));
    }
    void add(const Mouth& mouth) { mouths_.push_back(mouth); }
    bool empty() const { return outlines_.empty() && mouths_.empty(); }
    Region region(const Vec2& st, const Vec3& position) const;
    // Whether an outline may go through a cell.
    bool divides(const Cell& cell) const;
    // Whether points at this distance from `position` or nearer can lie in a band.
    bool has_bands(const Vec3& position, double distance) const;

private:
    std::vector<std::vector<Segment>> outlines_;
    std::vector<Mouth> mouths_;
};

// The footprints on each chart. Only quadrilaterals have and cause them, not round shapes. `near` is the largest
// distance of an edge from the chart's plane.
std::vector<Footprints> find_footprints(const Geometry& geometry, const std::vector<Chart>& charts, double near);

}  // namespace neumann
