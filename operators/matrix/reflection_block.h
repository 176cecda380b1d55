// How a material reflects between the cells of directions of a facet: out_i = Σ_j B_ij in_j, means over the cells.
//
//     B_ij = k²/π ∫_i ∫_j g(ωi, ωo) dω⊥i dω⊥o,   fs = ρ g
//
// Each row sums to the mean directional albedo of its cell, and B = Bᵀ, so that R* = R: reciprocity survives the finite number of
// samples by a symmetric scaling D B D.
//
// Where light goes through, both sides of a patch have one block: the cells of the front, then those of the back. Of basic
// radiance L/n² glass gives back as much as it takes, and with m_i the étendue of cell i, n²/k² but for a factor, m B is symmetric.
#pragma once

#include "core/material/bsdf.h"
#include "operators/patches/direction_cells.h"

#include <Eigen/SparseCore>

#include <array>
#include <span>
#include <vector>

namespace neumann {

class ReflectionBlock {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    // Every cell sends what arrives in it.
    explicit ReflectionBlock(DirectionCells cells);
    // Of a side that light does not go through, or beyond which there is nothing. The factor ρ is left out.
    ReflectionBlock(const Bsdf& bsdf, DirectionCells cells);
    // Of both sides of what light goes through.
    ReflectionBlock(const Bsdf& front, DirectionCells front_cells, const Bsdf& back, DirectionCells back_cells);

    // Of a colour channel.
    const Matrix& matrix(int channel) const { return matrices_[matrices_.size() == 1 ? 0 : static_cast<std::size_t>(channel)]; }

private:
    struct Side {
        Bsdf bsdf;
        DirectionCells cells;
        std::uint32_t first;  // of its cells
        double index;         // of refraction, but for a factor
    };
    static std::vector<std::vector<Rgb>> sampled_rows(std::span<const Side> sides);
    void build(std::span<const Side> sides);

    std::vector<Matrix> matrices_;  // one where all channels are alike
};

// D A D with the given row sums, for a symmetric A ≥ 0 whose rows sum to something near. Knight, Ruiz, Uçar, A symmetry preserving
// algorithm for matrix scaling, 2014.
void scale_symmetrically(ReflectionBlock::Matrix& A, const Eigen::VectorXd& row_sums);

}  // namespace neumann
