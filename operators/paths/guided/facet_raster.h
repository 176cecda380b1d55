// A fast approximate lookup of the facet at a point: a raster over each plane chart, whose cells store the facets at their centres.
// Near the edges of patches it may return a neighbouring facet, which is good enough for guiding.
#pragma once

#include "operators/fields/patches/patch_space.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace neumann {

class FacetRaster {
public:
    // Keeps a reference to the space.
    explicit FacetRaster(const PatchSpace& space);

    // The facet on the front or on the back; facets().size() if there is none.
    std::uint32_t facet(const SurfacePoint& p, bool front) const {
        const Patches& patches = space_->patches();
        const Grid& grid = grids_[patches.chart_of(p)];
        if (grid.columns == 0) return space_->facet(patches.locate(p), front);
        const Vec3 d = p.position - grid.corner;
        const std::uint32_t column = along(glm::dot(d, grid.across), grid.columns), row = along(glm::dot(d, grid.down), grid.rows);
        return sides_[grid.first + row * grid.columns + column][front ? 0 : 1];
    }

private:
    // A rectangle around a plane chart. It has no cells for round shapes.
    struct Grid {
        Vec3 corner, across{0.0}, down{0.0};  // cell coordinates of p are the dot products of p − corner with across and down
        std::uint32_t columns = 0, rows = 0;
        std::size_t first = 0;
    };
    static std::uint32_t along(double x, std::uint32_t cells) {
        return std::min(static_cast<std::uint32_t>(std::max(x, 0.0)), cells - 1);
    }

    const PatchSpace* space_;
    std::vector<Grid> grids_;                          // one per chart
    std::vector<std::array<std::uint32_t, 2>> sides_;  // for each cell, the facets of the front and of the back
};

}  // namespace neumann
