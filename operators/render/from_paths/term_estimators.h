// Estimators of all terms along camera rays, and the sampler of methods that need nothing else.
#pragma once

#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/walker.h"
#include "operators/paths/walk/walks.h"
#include "operators/render/from_paths/path_sampler.h"

#include <memory>
#include <span>
#include <utility>

namespace neumann {

class TermEstimator {
public:
    virtual ~TermEstimator() = default;
    // Adds the terms of each ray to the samples in `result`.
    virtual void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers,
                            TermSamples& result) const = 0;
    // The same for an observer, with nothing left out: it also reports rays whose results were known (retrace.cpp).
    virtual void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers,
                       TermSamples& result) const = 0;
};

// One walk for all terms: the fast way.
template <class Continuation>
class WalkEstimator : public TermEstimator {
public:
    WalkEstimator(const Scene& scene, const WalkSettings& settings, const Continuation& continuation)
        : scene_(&scene), settings_(settings), direct_(scene, direct_settings(settings)), continuation_(continuation) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers,
                    TermSamples& result) const override {
        walk(*scene_, direct_, settings_, rays, samplers, walkers, result, continuation_);
    }
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers,
               TermSamples& result) const override;

private:
    // The lights are not sampled if BSDF sampling alone is enough (LeftOut::light_samples).
    static DirectLightSettings direct_settings(const WalkSettings& settings) {
        DirectLightSettings direct = settings.direct;
        if (settings.left_out.light_samples && direct.direct == DirectLight::mis) direct.direct = DirectLight::bsdf;
        return direct;
    }

    const Scene* scene_;
    WalkSettings settings_;
    DirectLightSampler direct_;
    Continuation continuation_;
};

class EstimatorSampler : public PathSampler {
public:
    EstimatorSampler(const Scene& scene, const SamplingSettings& settings, std::unique_ptr<const TermEstimator> estimator)
        : PathSampler(scene, settings), estimator_(std::move(estimator)) {}

    const TermEstimator* of_pixels() const override { return settings_.method->sharing_pixels() > 1 ? nullptr : estimator_.get(); }
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    bool has_own_samples() const override { return true; }
    std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const override;
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;

private:
    std::unique_ptr<const TermEstimator> estimator_;
};

template <class Continuation>
std::shared_ptr<const PathSampler> walk_sampler(const Scene& scene, const SamplingSettings& settings,
                                                const Continuation& continuation) {
    return std::make_shared<const EstimatorSampler>(
        scene, settings, std::make_unique<const WalkEstimator<Continuation>>(scene, settings.walk, continuation));
}

}  // namespace neumann
