// The hemisphere cut into k × k cells of equal projected solid angle π/k²: a grid on the square that is mapped onto Nusselt's disc.
// Turning a direction by half a circle about the normal, as a mirror does, takes cell (i, j) to (k−1−i, k−1−j).
#pragma once

#include "core/sampling/warp.h"

#include <algorithm>
#include <cstdint>

namespace neumann {

struct DirectionCells {
    std::uint32_t k = 1;

    std::uint32_t size() const { return k * k; }
    // The cell of a direction in the local frame, cos θ > 0.
    std::uint32_t cell(const Vec3& w) const { return k == 1 ? 0 : cell_of_square(square_of_disk(Vec2(w))); }
    std::uint32_t cell_of_square(const Vec2& u) const { return along(u.y) * k + along(u.x); }
    std::uint32_t mirrored(std::uint32_t cell) const { return size() - 1 - cell; }
    // The first function halves the number of cells along both axes; the second returns the coarser cell that contains a cell.
    DirectionCells coarser() const { return {std::max(k / 2, 1u)}; }
    std::uint32_t coarser(std::uint32_t cell) const { return k == 1 ? 0 : cell / k / 2 * (k / 2) + cell % k / 2; }
    // A direction that is uniform in projected solid angle if u is uniform in [0, 1)².
    Vec3 direction(std::uint32_t cell, const Vec2& u) const {
        return cosine_hemisphere({(cell % k + u.x) / k, (cell / k + u.y) / k});
    }

private:
    std::uint32_t along(double u) const { return std::min(static_cast<std::uint32_t>(std::max(u, 0.0) * k), k - 1); }
};

}  // namespace neumann
