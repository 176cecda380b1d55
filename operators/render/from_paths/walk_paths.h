// The walk: paths from the camera sample directions by the BSDF. It may also be a tree, use its neighbours' tails, or sample
// directions over the hemisphere.
#pragma once

#include "operators/paths/walk/hemisphere_continuation.h"
#include "operators/paths/walk/tree_ratios.h"
#include "operators/render/from_paths/path_method.h"

#include <optional>

namespace neumann {

class WalkPaths : public PathMethod {
public:
    WalkPaths() = default;
    // Walks split and end by these numbers (tree_walk.h).
    explicit WalkPaths(std::shared_ptr<const TreeRatios> tree) : tree_(std::move(tree)) {}
    // This many consecutive pixels use each other's tails (reusing_walk.h).
    explicit WalkPaths(std::uint32_t sharing_pixels) : sharing_pixels_(sharing_pixels) {}
    // Walks go on in directions of this density.
    explicit WalkPaths(HemisphereDensity directions) : directions_(directions) {}

    // Null if walks are not trees.
    const TreeRatios* tree() const { return tree_.get(); }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    bool is_prepared() const override { return tree_ != nullptr; }
    std::uint64_t rays() const override { return tree_ ? tree_->rays : 0; }
    double walks_worth(int bounces, std::span<const double> rays_of_walk) const override;
    bool first_may_be_late() const override { return false; }
    std::uint32_t sharing_pixels() const override { return sharing_pixels_; }
    bool is_bounded(const SamplingSettings& settings) const override;
    bool ends_by_roulette() const override { return !tree_ && sharing_pixels_ == 1; }

private:
    std::shared_ptr<const TreeRatios> tree_;
    std::uint32_t sharing_pixels_ = 1;
    std::optional<HemisphereDensity> directions_;
};

}  // namespace neumann
