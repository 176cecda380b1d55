// Samples the terms by corrected fields (operators/paths/corrected/corrected_walk.h). All pixels of a replicate share points, so a
// replicate is a whole picture.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/walk/observer.h"
#include "operators/render/from_paths/path_sampler.h"

#include <memory>
#include <optional>
#include <vector>

namespace neumann {

class DirectLightSampler;
class PointMaker;
struct SharedPoints;

// Walks from the camera that read approximate fields on patches at the second diffuse surface, whose errors are carried by points
// that all pixels share.
class CorrectedPaths : public PathMethod {
public:
    explicit CorrectedPaths(std::shared_ptr<const Approximation> approximation) : approximation_(std::move(approximation)) {}
    const Approximation& approximation() const { return *approximation_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    bool is_prepared() const override { return true; }
    std::uint64_t rays() const override { return approximation_->rays(); }
    double walks_worth(int, std::span<const double>) const override { return 2.0; }
    bool is_bounded(const SamplingSettings&) const override { return true; }
    bool has_events() const override { return false; }  // contributions of points may be negative
    std::string why_no_balance() const override { return "a walk's weight is only what points that pixels share leave to it"; }

private:
    std::shared_ptr<const Approximation> approximation_;
};

class CorrectedSampler : public PathSampler {
public:
    // The rays for the points of a replicate, as a rough part of those for its pixels; it is larger in small pictures.
    static constexpr double share_of_points = 0.1;

    CorrectedSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const Approximation> approximation);

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    bool has_own_samples() const override { return true; }
    std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const override;
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;
    std::unique_ptr<const PathsToInspect> to_inspect() const override;

    // The points that the pixels of a replicate share; nothing if no surface is diffuse.
    std::optional<SharedPoints> points_of(std::uint64_t replicate) const;
    // As above, with these points, or without any if null.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, const SharedPoints* points,
                             PathObserver& observer) const;

private:
    struct Workspace;
    // The stream of the walks from first diffuse vertices, whose random numbers are independent of the others.
    static constexpr std::uint64_t direction_stream = 0x676174686572ull;
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const SharedPoints* points, Workspace& work,
                     const Observer& observer = {}) const;

    std::shared_ptr<const Approximation> approximation_;
    std::shared_ptr<const DirectLightSampler> direct_;
    std::shared_ptr<const PointMaker> points_;  // refers to *direct_ and to *approximation_
    std::vector<SobolPoints> direction_nets_;   // for pixels with 1, 2, 4, … samples
};

}  // namespace neumann
