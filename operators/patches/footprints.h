// Where other surfaces touch a chart, or come as near to it as a patch is wide: their outlines, seen perpendicularly, divide it.
// Light falls off abruptly across such a line (the floor under a box, the ceiling above a lamp), so patches do not reach across it
// and fields are not interpolated across it.
//
// Light in a narrow gap goes to and fro many times and moves on by about the gap's width each time, so that what leaks out comes
// from a few widths' depth, and patches that reach deeper mix it with light that stays. Along the mouth of a gap both surfaces are
// divided into bands, a fifth narrower each towards the mouth.
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
    static constexpr std::uint32_t bands = 19;

    struct Segment {
        Vec2 a, b;  // (s, t) of the chart
    };
    struct Mouth {
        Vec3 a, b;     // a line in the chart's plane
        double depth;  // to which there are bands
    };
    // Of one more shape; outlines that are no closed lines divide nothing sensible and are the caller's to leave out.
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

// For each chart. Quadrilaterals only: round shapes neither have nor throw outlines. `near`: how far an edge may be from the plane.
std::vector<Footprints> find_footprints(const Geometry& geometry, const std::vector<Chart>& charts, double near);

}  // namespace neumann
