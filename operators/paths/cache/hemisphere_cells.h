// The hemisphere over a point in M × N cells of equal projected solid angle, and what the radiance L_jk of a ray in
// each cell contributes to the irradiance there and nearby:
//
//     E = π/(MN) Σ L_jk,    sin²θ from j/M to (j + 1)/M, φ from 2π k/N to 2π (k + 1)/N
//
// The derivatives of E are those of light that is constant in each cell (Ward and Heckbert, Irradiance Gradients, 1992). If the
// normal turns, the cosines change: ∂E/∂n = ∫ L ω dω, of which the part in the tangent plane counts. If the point moves by u, the
// boundary between two cells is seen to move as the nearer of the two surfaces there, at the distance r:
//
//     ∂E/∂u = Σ ΔL ∫ (n·q) (dl × q)·u / |q|⁴,   q from the point to the boundary, |q| = r, ΔL the difference across it
//
// and, since dq = −du, ∂²E/∂u² = Σ 4 ΔL ∫ (n·q) (dl × q)·u (q·u) / |q|⁶ (after Schwarzhaupt, Jensen and Jarosz, 2012, who join the
// hits to triangles).
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

class HemisphereCells {
public:
    // Makes about `rays` cells, with N ≈ π M so that cells are about as wide as high.
    explicit HemisphereCells(std::uint32_t rays);

    std::size_t size() const { return std::size_t{rings_} * sectors_; }

    // A direction about +z in a cell, with a pdf in proportion to the cosine.
    Vec3 direction(std::size_t cell, const Vec2& u) const;
    // π/(MN), the weight of L of a cell in E.
    double weight() const;
    // The weights of L of a cell in ∂E/∂n, along x and y.
    const Vec2& rotation(std::size_t cell) const { return rotation_[cell]; }
    // Finds the weights of L of each cell in ∂E/∂u, along x and y, from 1/r of each cell, which is 0 where nothing was hit.
    void translation(std::span<const double> inverse_distances, std::span<Vec2> weights) const;
    // ∂²E/∂x², ∂²E/∂x∂y and ∂²E/∂y².
    Vec3 hessian(std::span<const double> radiance, std::span<const double> inverse_distances) const;

private:
    // Calls ring(cell, next, sin²θ, k) for the boundaries between rings and sector(cell, next, j, φ's direction) for
    // those between sectors; `next` is farther from the pole, or counter-clockwise.
    template <class Ring, class Sector>
    void for_boundaries(const Ring& ring, const Sector& sector) const;

    std::uint32_t rings_, sectors_;  // M, N
    std::vector<Vec2> rotation_;
    std::vector<Vec2> middle_, edge_;  // (cos φ, sin φ) in the middle of each sector, and where it begins
    std::vector<double> sine_;         // sin θ where each ring begins, and at π/2
    double sector_sine_;               // ∫ cos φ over a sector about 0: 2 sin(π/N)
};

}  // namespace neumann
