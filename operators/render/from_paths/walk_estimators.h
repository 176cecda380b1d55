// Estimators by walks that are trees, and by walks that use each other's tails.
#pragma once

#include "operators/paths/corrected/diffuse_sides.h"
#include "operators/paths/walk/tree_ratios.h"
#include "operators/render/from_paths/term_estimators.h"

namespace neumann {

// A walk that splits and ends by the best numbers for its depths.
class TreeEstimator : public TermEstimator {
public:
    TreeEstimator(const Scene& scene, const WalkSettings& settings, std::shared_ptr<const TreeRatios> ratios)
        : scene_(&scene), settings_(settings), direct_(scene, settings.direct), ratios_(std::move(ratios)) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const override;
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
               TermSamples& result) const override;

private:
    const Scene* scene_;
    WalkSettings settings_;
    DirectLightSampler direct_;
    std::shared_ptr<const TreeRatios> ratios_;
};

// Walks that use each other's tails. Their pixels are not independent.
class ReusingEstimator : public TermEstimator {
public:
    // `size`: samples of a pixel; `sharing`: number of consecutive pixels that use each other's tails.
    ReusingEstimator(const Scene& scene, const WalkSettings& settings, std::size_t size, std::size_t sharing)
        : scene_(&scene),
          settings_(settings),
          size_(size),
          sharing_(sharing),
          direct_(scene, settings.direct),
          diffuse_(scene, Normals::geometric) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const override;
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
               TermSamples& result) const override;

private:
    const Scene* scene_;
    WalkSettings settings_;
    std::size_t size_, sharing_;
    DirectLightSampler direct_;
    DiffuseSides diffuse_;
};

}  // namespace neumann
