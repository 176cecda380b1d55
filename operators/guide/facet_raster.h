// Which facets a point is about on, in a few operations: a raster over each plane chart, whose cells know what is at their middles.
// Near the edges of patches the answer is a neighbour's, so this is for those to whom any answer of the place does.
#pragma once

#include "operators/patches/patch_space.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace neumann {

class FacetRaster {
public:
    // The space is kept by reference.
    explicit FacetRaster(const PatchSpace& space);

    // On the front or on the back; facets().size() where there is none.
    std::uint32_t facet(const SurfacePoint& p, bool front) const {
        const Patches& patches = space_->patches();
        const Grid& grid = grids_[patches.chart_of(p)];
        if (grid.columns == 0) return space_->facet(patches.locate(p), front);
        const Vec3 d = p.position - grid.corner;
        const std::uint32_t column = along(glm::dot(d, grid.across), grid.columns), row = along(glm::dot(d, grid.down), grid.rows);
        return sides_[grid.first + row * grid.columns + column][front ? 0 : 1];
    }

private:
    // A rectangle around a plane chart; none for round shapes.
    struct Grid {
        Vec3 corner, across{0.0}, down{0.0};  // of cells: one more along each is the next cell
        std::uint32_t columns = 0, rows = 0;
        std::size_t first = 0;
    };
    static std::uint32_t along(double x, std::uint32_t cells) {
        return std::min(static_cast<std::uint32_t>(std::max(x, 0.0)), cells - 1);
    }

    const PatchSpace* space_;
    std::vector<Grid> grids_;                          // of each chart
    std::vector<std::array<std::uint32_t, 2>> sides_;  // of each cell: facets of the front and of the back
};

}  // namespace neumann
