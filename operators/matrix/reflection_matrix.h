// R on a patch space: what leaves a facet in each cell of its directions is what arrives in all of them, means over the facet's
// rays, times the material's block and the facet's reflectance. Materials only.
//
// A diffuse facet has one cell, whose block is 1. A patch's reflectance is the mean of its points'; rows then sum to the mean
// directional albedo, so that ‖R‖∞ is at most the largest albedo and the white furnace holds to rounding on any mesh. The two facets
// of a patch that light goes through share a block.
#pragma once

#include "core/scene/scene.h"
#include "operators/matrix/reflection_block.h"
#include "operators/matrix/transport_matrix.h"

#include <memory>

namespace neumann {

// A material's block where it stands: its rows and columns begin with the unknown `first`. Null stands for 1.
struct FacetBlock {
    std::shared_ptr<const ReflectionBlock> block;
    std::uint32_t first = 0;
};

template <int C>
class ReflectionMatrix {
public:
    using Domain = IncidentVector<C>;
    using Range = ExitantVector<C>;
    using Reflectance = Eigen::Array<double, C, Eigen::Dynamic>;

    // The space is kept by reference.
    ReflectionMatrix(const Materials& materials, const PatchSpace& space);
    // Every cell of every facet sends what arrives in it: R T is then T, the means over its rays.
    static ReflectionMatrix identity(const PatchSpace& space);
    // One colour channel, 0 … 2.
    ReflectionMatrix<1> channel(int c) const;

    Range operator()(const Domain& g) const;
    // The same of means over the cells, one for each unknown.
    Range of_means(Range means) const;

    const PatchSpace& space() const { return *space_; }
    // Of each facet.
    const Reflectance& reflectance() const { return reflectance_; }
    // Of a facet, null for 1, and the unknown that its rows and columns begin with.
    const ReflectionBlock::Matrix* block(std::uint32_t facet, int channel = 0) const {
        return blocks_[facet].block ? &blocks_[facet].block->matrix(channel_ + channel) : nullptr;
    }
    std::uint32_t first_of_block(std::uint32_t facet) const { return blocks_[facet].first; }

private:
    template <int>
    friend class ReflectionMatrix;
    using Blocks = std::vector<FacetBlock>;
    ReflectionMatrix(const PatchSpace& space, Reflectance reflectance, Blocks blocks, int channel)
        : space_(&space), reflectance_(std::move(reflectance)), blocks_(std::move(blocks)), channel_(channel) {}
    // The back of a patch whose front has the block of both.
    bool goes_with_front(std::uint32_t facet) const {
        return blocks_[facet].block && blocks_[facet].first != space_->facets()[facet].first;
    }
    void reflect_cells(std::uint32_t facet, double* values) const;

    const PatchSpace* space_;
    Reflectance reflectance_;
    Blocks blocks_;    // of each facet; patches of a material share one
    int channel_ = 0;  // of the blocks, where C is 1
};

extern template class ReflectionMatrix<1>;
extern template class ReflectionMatrix<4>;

}  // namespace neumann
