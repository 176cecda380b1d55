#include "operators/render/from_paths/walk_paths.h"

#include "operators/paths/reuse/reusing_walk.h"
#include "operators/paths/walk/tree_walk.h"
#include "operators/render/from_paths/walk_estimators.h"

namespace neumann {

std::shared_ptr<const PathMethod> plain_walks() {
    static const std::shared_ptr<const PathMethod> walks = std::make_shared<const WalkPaths>();
    return walks;
}

void TreeEstimator::operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const {
    TreeWalkers tree;
    walk_tree(*scene_, direct_, settings_, *ratios_, rays, samplers, tree, result);
}

void ReusingEstimator::operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
                                  TermSamples& result) const {
    walk_reusing(*scene_, direct_, diffuse_, settings_, size_, sharing_, rays, samplers, result,
                 [&](const WalkSettings& settings, std::span<Sampler> random, Walkers& tails, TermSamples& found, const auto&) {
                     walk_on(*scene_, direct_, settings, random, tails, found, MaterialContinuation());
                 });
}

std::shared_ptr<const PathSampler> WalkPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    std::unique_ptr<const TermEstimator> estimator;
    if (sharing_pixels_ > 1)
        estimator = std::make_unique<const ReusingEstimator>(scene, settings.walk, settings.replicate_size, sharing_pixels_);
    else if (tree_)
        estimator = std::make_unique<const TreeEstimator>(scene, settings.walk, tree_);
    else if (directions_)
        return walk_sampler(scene, settings, HemisphereContinuation(*directions_));
    else
        return walk_sampler(scene, settings, MaterialContinuation());
    return std::make_shared<const EstimatorSampler>(scene, settings, std::move(estimator));
}

double WalkPaths::walks_worth(int, std::span<const double> rays_of_walk) const { return tree_ ? tree_->walks(rays_of_walk) : 1.0; }

// Lobes have no bound that holds for other directions than their own.
bool WalkPaths::is_bounded(const SamplingSettings& settings) const { return settings.weighs_directions() && !directions_; }

}  // namespace neumann
