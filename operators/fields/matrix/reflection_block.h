// The matrix of a material's reflection between a facet's cells of directions: out_i = Σ_j B_ij in_j, for means over the cells.
//
//     B_ij = k²/π ∫_i ∫_j g(ωi, ωo) dω⊥i dω⊥o,   fs = ρ g
//
// Each row sums to the mean directional albedo of its cell, and B = Bᵀ, so R* = R. B is sampled; a symmetric scaling D B D keeps it
// reciprocal.
//
// If the material transmits light, both sides of a patch share one block: first the cells of the front, then those of the back.
// Glass conserves basic radiance L/n². With m_i the étendue of cell i, which is n²/k² up to a factor, m B is symmetric.
#pragma once

#include "core/material/bsdf.h"
#include "operators/fields/patches/direction_cells.h"

#include <Eigen/SparseCore>

#include <array>
#include <span>
#include <vector>

namespace neumann {

class ReflectionBlock {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    // The identity block.
    explicit ReflectionBlock(DirectionCells cells);
    // The block of a side that does not transmit light, or beyond which there is nothing. The factor ρ is left out.
    ReflectionBlock(const Bsdf& bsdf, DirectionCells cells);
    // The block of both sides of a material that transmits light.
    ReflectionBlock(const Bsdf& front, DirectionCells front_cells, const Bsdf& back, DirectionCells back_cells);

    // The matrix of a colour channel.
    const Matrix& matrix(int channel) const { return matrices_[matrices_.size() == 1 ? 0 : static_cast<std::size_t>(channel)]; }

private:
    struct Side {
        Bsdf bsdf;
        DirectionCells cells;
        std::uint32_t first;  // number of its first cell
        double index;         // refractive index, up to a common factor
    };
    static std::vector<std::vector<Rgb>> sampled_rows(std::span<const Side> sides);
    void build(std::span<const Side> sides);

    std::vector<Matrix> matrices_;  // a single one if all channels are alike
};

// Replaces a symmetric A ≥ 0 by D A D with the given row sums; the row sums of A should be close to them. Knight, Ruiz, Uçar, A
// symmetry preserving algorithm for matrix scaling, 2014.
void scale_symmetrically(ReflectionBlock::Matrix& A, const Eigen::VectorXd& row_sums);

}  // namespace neumann
