// Where other surfaces touch a chart, or come as near to it as a patch is wide: their outlines, seen perpendicularly, divide it.
// Light falls off abruptly across such a line (the floor under a box, the ceiling above a lamp), so patches do not reach across it
// and fields are not interpolated across it.
#pragma once

#include "operators/patches/chart.h"

#include <map>
#include <vector>

namespace neumann {

// The outlines on one chart. A point's class is a bit for each shape: whether the point lies within the shape's outline.
class Footprints {
public:
    static constexpr std::size_t most_shapes = 16;

    struct Segment {
        Vec2 a, b;  // (s, t) of the chart
    };
    // Of one more shape; outlines that are no closed lines divide nothing sensible and are the caller's to leave out.
    void add(std::vector<Segment> outline) {
        if (outlines_.size() < most_shapes) outlines_.push_back(std::move(outline));
    }
    bool empty() const { return outlines_.empty(); }
    std::uint32_t classes(const Vec2& st) const;

private:
    std::vector<std::vector<Segment>> outlines_;
};

// For each chart. Quadrilaterals only: round shapes neither have nor throw outlines. `near`: how far an edge may be from the plane.
std::vector<Footprints> find_footprints(const Geometry& geometry, const std::vector<Chart>& charts, double near);

}  // namespace neumann
