// Samples the terms by photon maps (operators/paths/photons/photon_walk.h). All pixels of a replicate read the same photons, so a
// replicate is a whole picture: a pass of progressive photon mapping.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/photons/photon_pilot.h"
#include "operators/paths/photons/photon_tracer.h"
#include "operators/paths/walk/observer.h"
#include "operators/render/from_paths/path_sampler.h"

#include <memory>
#include <vector>

namespace neumann {

class DirectLightSampler;
struct PhotonPass;

class PhotonPaths : public PathMethod {
public:
    explicit PhotonPaths(std::shared_ptr<const PhotonPilot> pilot) : pilot_(std::move(pilot)) {}
    const PhotonPilot& pilot() const { return *pilot_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    bool is_prepared() const override { return true; }
    std::uint64_t rays() const override { return pilot_->rays; }
    double walks_worth(int, std::span<const double>) const override { return 16.0; }
    // The radii are r and r/√2. Where light has edges the error is of order r, and the difference is 1 − 1/√2 of it;
    // where it is smooth the error is of order r², and the difference is half of it. The former is taken.
    std::optional<TwoRadii> two_radii() const override;
    bool is_bounded(const SamplingSettings&) const override { return false; }
    bool is_boundless(std::size_t quantity) const override { return quantity > 1; }
    bool has_events() const override { return false; }  // samples are means of many photons
    std::string why_no_checkup() const override {
        return "photons are shared by all pixels, and those of a pass are traced together";
    }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::bidirectional}}; }

private:
    const char* unfound_in_mirrors() const override { return unfound_from_both_ends; }

    std::shared_ptr<const PhotonPilot> pilot_;
};

class PhotonSampler : public PathSampler {
public:
    PhotonSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const PhotonPilot> pilot);

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    // Traces all photons of the replicate again.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;
    // `path`: the number of a path that left photons.
    std::uint32_t of_read(std::uint32_t path) const override { return path % PhotonTracer::at_once; }
    void retrace_read(std::uint64_t replicate, std::uint32_t path, PathObserver& observer) const override;

private:
    struct Workspace;
    std::optional<PhotonPass> make_pass(std::uint64_t replicate, std::vector<std::uint64_t>& rays, std::uint64_t& given_up,
                                        const Watch& watch) const;
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const PhotonPass& pass, Workspace& work,
                     const Observer& observer = {}) const;

    std::shared_ptr<const PhotonPilot> pilot_;
    std::shared_ptr<const DirectLightSampler> direct_;
    PhotonTracer photons_;
};

}  // namespace neumann
