// Where other surfaces touch a chart, or come as near to it as a patch is wide: their outlines, seen perpendicularly, divide it.
// Light falls off abruptly across such a line (the floor under a box, the ceiling above a lamp), so patches do not reach across it
// and fields are not interpolated across it.
//
// Where a narrow gap opens, light leaks out of it within a few of its widths: there bands along the gap's mouth, each half as wide
// as the next, down to the gap's width, divide both surfaces.
#pragma once

#include "operators/patches/chart.h"

#include <map>
#include <vector>

namespace neumann {

// Where a point lies among the outlines on a chart.
struct Region {
    std::uint32_t shapes = 0;  // a bit for each: the point lies within its outline
    std::uint32_t band = 0;    // 0: far from gaps
    auto operator<=>(const Region&) const = default;
};

class Footprints {
public:
    static constexpr std::size_t most_shapes = 16;
    static constexpr std::uint32_t most_bands = 5;

    struct Segment {
        Vec2 a, b;  // (s, t) of the chart
    };
    struct Mouth {
        Vec3 a, b;            // a line in the chart's plane
        std::uint32_t bands;  // at least 1
    };
    // `near`: the width of the outermost band.
    explicit Footprints(double near) : near_(near) {}
    // Of one more shape; outlines that are no closed lines divide nothing sensible and are the caller's to leave out.
    void add(std::vector<Segment> outline) {
        if (outlines_.size() < most_shapes) outlines_.push_back(std::move(outline));
    }
    void add(const Mouth& mouth) { mouths_.push_back(mouth); }
    bool empty() const { return outlines_.empty() && mouths_.empty(); }
    Region region(const Vec2& st, const Vec3& position) const;
    // Whether points at this distance from `position` or nearer can lie in a band.
    bool has_bands(const Vec3& position, double distance) const;

private:
    double near_;
    std::vector<std::vector<Segment>> outlines_;
    std::vector<Mouth> mouths_;
};

// For each chart. Quadrilaterals only: round shapes neither have nor throw outlines. `near`: how far an edge may be from the plane.
std::vector<Footprints> find_footprints(const Geometry& geometry, const std::vector<Chart>& charts, double near);

}  // namespace neumann
