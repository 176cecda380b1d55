// R on a patch space: exitant radiance of a facet's cells of directions = reflectance · block · incident radiance of its cells. R
// depends on the materials alone, not on visibility.
//
// A diffuse facet has one cell, whose block is 1. A patch's reflectance is the mean over its points; rows then sum to the mean
// directional albedo, so ‖R‖∞ is at most the largest albedo, and the white furnace test holds to rounding on any mesh. The two
// facets of a patch that transmits light share a block.
//
// R is reciprocal: R*, which maps exitant to incident importance, has the same entries as R.
#pragma once

#include "core/material/materials.h"
#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/matrix/reflection_block.h"
#include "operators/fields/patches/patch_space.h"

#include <memory>

namespace neumann {

// A material's block and its place in R: its rows and columns begin with the unknown `first`. A null pointer stands for 1.
struct FacetBlock {
    std::shared_ptr<const ReflectionBlock> block;
    std::uint32_t first = 0;
};

template <int C>
class AdjointReflectionMatrix;

template <int C>
class ReflectionMatrix {
public:
    using Domain = IncidentVector<C>;
    using Range = ExitantVector<C>;
    using Reflectance = Eigen::Array<double, C, Eigen::Dynamic>;

    // The space is kept by reference.
    ReflectionMatrix(const Materials& materials, const PatchSpace& space);
    // R without materials: exitant radiance equals incident radiance, so R T has the entries of T.
    static ReflectionMatrix identity(const PatchSpace& space);
    // One colour channel, 0 … 2.
    ReflectionMatrix<1> channel(int c) const;

    // Works in place if g is moved in.
    Range operator()(Domain g) const { return Range(reflect(std::move(g).values())); }
    AdjointReflectionMatrix<C> adjoint() const { return AdjointReflectionMatrix<C>(*this); }
    // The entries of row u.
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const requires(C == 1) {
        const std::uint32_t f = space_->facet_of(u);
        const double rho = (*reflectance_)(0, f);
        const ReflectionBlock::Matrix* const B = block(f);
        if (!B) {
            each(u, rho);
            return;
        }
        const std::uint32_t first = first_of_block(f);
        for (ReflectionBlock::Matrix::InnerIterator entry(*B, u - first); entry; ++entry)
            each(first + static_cast<std::uint32_t>(entry.col()), rho * entry.value());
    }

    const PatchSpace& space() const { return *space_; }
    // The reflectance of each facet.
    const Reflectance& reflectance() const { return *reflectance_; }
    // The block of a facet (null stands for 1), and the unknown at which its rows and columns begin.
    const ReflectionBlock::Matrix* block(std::uint32_t facet, int channel = 0) const {
        const FacetBlock& of = (*blocks_)[facet];
        return of.block ? &of.block->matrix(channel_ + channel) : nullptr;
    }
    std::uint32_t first_of_block(std::uint32_t facet) const { return (*blocks_)[facet].first; }
    // Whether the facet is the back of a patch whose block is stored with the front.
    bool goes_with_front(std::uint32_t facet) const {
        return block(facet) && first_of_block(facet) != space_->facets()[facet].first;
    }
    // Applies the block of a facet in place to the values of its cells. If the back shares the block, the values of its
    // cells follow.
    void reflect_cells(std::uint32_t facet, double* values) const;

private:
    template <int>
    friend class ReflectionMatrix;
    template <int>
    friend class AdjointReflectionMatrix;
    using Blocks = std::vector<FacetBlock>;
    using Values = typename Domain::Values;
    ReflectionMatrix(const PatchSpace& space, Reflectance reflectance, std::shared_ptr<const Blocks> blocks, int channel)
        : space_(&space),
          reflectance_(std::make_shared<const Reflectance>(std::move(reflectance))),
          blocks_(std::move(blocks)),
          channel_(channel) {}
    Values reflect(Values means) const;

    const PatchSpace* space_;
    std::shared_ptr<const Reflectance> reflectance_;
    std::shared_ptr<const Blocks> blocks_;  // one for each facet; patches of the same material share it
    int channel_ = 0;                       // the channel of the blocks if C is 1
};

template <int C>
class AdjointReflectionMatrix {
public:
    using Domain = ExitantVector<C>;
    using Range = IncidentVector<C>;

    explicit AdjointReflectionMatrix(ReflectionMatrix<C> R) : R_(std::move(R)) {}

    Range operator()(Domain f) const { return Range(R_.reflect(std::move(f).values())); }
    ReflectionMatrix<C> adjoint() const { return R_; }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const requires(C == 1) {
        R_.for_row(u, each);
    }

private:
    ReflectionMatrix<C> R_;
};

extern template class ReflectionMatrix<1>;
extern template class ReflectionMatrix<4>;

}  // namespace neumann
