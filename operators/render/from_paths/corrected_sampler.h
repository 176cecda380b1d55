// Samples the terms by corrected fields (operators/paths/corrected/corrected_walk.h). All pixels of a replicate share points, so a
// replicate is a whole picture.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/corrected/corrected_walk.h"
#include "operators/paths/walk/observer.h"
#include "operators/render/from_paths/path_sampler.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace neumann {

// The numbers of all parts of a pixel's samples (corrected_allocation.cpp).
struct CorrectedAllocation : Allocation {
    FirstVertex first{.lights = 1, .directions = 4, .points = 1, .clamp = 100.0};
    // How many samples of a pixel go on from their first diffuse vertex, as an exponent like those of Allocation; nothing: all.
    std::optional<std::int8_t> going_on = {};
};

class DirectLightSampler;
class PointMaker;

// Walks from the camera that read approximate fields on patches at the second diffuse surface, whose errors are carried by points
// that all pixels share.
class CorrectedPaths : public PathMethod {
public:
    // `caustics`: null if walks from the camera make all light.
    explicit CorrectedPaths(std::shared_ptr<const Approximation> approximation, std::shared_ptr<const CausticAim> caustics = {})
        : approximation_(std::move(approximation)), caustics_(std::move(caustics)) {}
    const Approximation& approximation() const { return *approximation_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    std::shared_ptr<const Allocation> allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                               const Watch& watch) const override;
    // About the rays that allocate() casts for a film of this size, and those of a sample without it.
    static double rays_of_allocation(double pixels);
    static constexpr double rays_of_sample = 7.0;
    bool is_prepared() const override { return true; }
    std::uint64_t rays() const override { return approximation_->rays() + (caustics_ ? caustics_->rays() : 0); }
    bool splats() const override { return makes_caustics(); }
    double walks_worth(int, std::span<const double>) const override { return 2.0; }
    bool is_bounded(const SamplingSettings&) const override { return !makes_caustics(); }
    bool is_boundless(std::size_t quantity) const override { return makes_caustics() && quantity > 1; }
    bool has_events() const override { return false; }  // contributions of points may be negative
    std::string why_no_balance() const override { return "a walk's weight is only what points that pixels share leave to it"; }

private:
    bool makes_caustics() const { return caustics_ && caustics_->pays(); }

    std::shared_ptr<const Approximation> approximation_;
    std::shared_ptr<const CausticAim> caustics_;
};

class CorrectedSampler : public PathSampler {
public:
    // The rays for the points of a replicate, as a rough part of those for its pixels; it is larger in small pictures.
    static constexpr double share_of_points = 0.1;

    // Paths from lamps make caustics if these are not null and pay.
    CorrectedSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const Approximation> approximation,
                     std::shared_ptr<const CausticAim> caustics = {});

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    bool has_own_samples() const override { return true; }
    std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const override;
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;
    std::unique_ptr<const PathsToInspect> to_inspect() const override;

    // The points that all pixels of a replicate share.
    struct Shared {
        std::optional<SharedPoints> errors, caustics;
        JoinedPoints points() const { return {errors ? &*errors : nullptr, caustics ? &*caustics : nullptr}; }
    };
    // Calls seen() for the light that the camera sees from paths from the lamps, unless it is null. Adds to `rays`, by bounce, and
    // for the walks given up to `given_up`. Nothing if `watch` stopped it.
    std::optional<Shared> shared(std::uint64_t replicate, const std::function<void(const Caustics::Seen&)>& seen,
                                 std::vector<std::uint64_t>& rays, std::uint64_t& given_up, const Watch& watch) const;
    // The samples of all pixels with these points. False if `watch` stopped it.
    bool own_samples(std::uint64_t replicate, const JoinedPoints& points, const OwnSamples& each, const Watch& watch) const;
    // As above, with these points.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, const JoinedPoints& points,
                             PathObserver& observer) const;

private:
    struct Workspace;
    // The stream of the walks from first diffuse vertices, whose random numbers are independent of the others.
    static constexpr std::uint64_t direction_stream = 0x676174686572ull;
    // If no sample goes on, as in a pilot for direct light, rays that would have met a light have next to no weight.
    static constexpr double share_of_none = 1.0 / 1024.0;
    std::uint32_t size_of_going_on(std::uint32_t size) const {
        return going_on_ ? std::min(Allocation::size_of(settings_.replicate_size, *going_on_), size) : size;
    }
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const JoinedPoints& points, Workspace& work,
                     const Observer& observer = {}) const;

    std::shared_ptr<const Approximation> approximation_;
    std::shared_ptr<const CausticAim> aim_;
    std::optional<Caustics> caustics_;
    std::shared_ptr<const DirectLightSampler> direct_;
    std::shared_ptr<const PointMaker> points_;  // refers to *direct_ and to *approximation_
    FirstVertex first_ = CorrectedAllocation().first;
    std::optional<std::int8_t> going_on_;
    std::vector<SobolPoints> direction_nets_;  // for pixels with 1, 2, 4, … samples that go on
};

}  // namespace neumann
