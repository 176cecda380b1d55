// Cells cut into parts along outlines and bands (footprints.h).
#pragma once

#include "operators/fields/patches/footprints.h"

#include <cstdint>
#include <map>
#include <vector>

namespace neumann {

// The part of a cell that lies in one region, given by the squares of a grid on the cell that overlap it. Parts can share squares.
struct Part {
    std::uint32_t along = 0;  // number of squares along each axis of the grid
    double share = 0.0;       // fraction of the cell's area
    std::vector<std::uint16_t> squares;

    // A point that is uniform by area if u is uniform in [0, 1)².
    SurfacePoint point(const Geometry& geometry, const Chart& chart, const Footprints& footprints, const Cell& cell, Region region,
                       Vec2 u) const;
};

using Parts = std::map<Region, Part>;

// Returns a single part without squares if nothing divides the cell.
Parts find_parts(const Geometry& geometry, const Chart& chart, const Footprints& footprints, const Cell& cell);

}  // namespace neumann
