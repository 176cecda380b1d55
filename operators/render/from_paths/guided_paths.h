// Walks whose diffuse reflections sample tables of the incident light (path guiding).
#pragma once

#include "operators/paths/guided/guide.h"
#include "operators/render/from_paths/path_method.h"

namespace neumann {

class GuidedPaths : public PathMethod {
public:
    explicit GuidedPaths(std::shared_ptr<const Guide> guide) : guide_(std::move(guide)) {}
    const Guide& guide() const { return *guide_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    bool is_prepared() const override { return true; }
    std::uint64_t rays() const override { return guide_->rays(); }
    double walks_worth(int, std::span<const double>) const override { return 2.0; }
    // Samples can be bounded because the tables mix in the BSDF.
    bool is_bounded(const SamplingSettings& settings) const override;

private:
    std::shared_ptr<const Guide> guide_;
};

}  // namespace neumann
