// Light tracing and bidirectional path tracing. Paths from the lights may contribute to any pixel, so a replicate is a
// whole picture. A replicate has as many paths as camera samples, and each is added to the pixels whose filter covers
// its position on the film.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/bidirectional/bidirectional.h"
#include "operators/paths/light/light_tracing.h"
#include "operators/render/from_paths/path_sampler.h"

namespace neumann {

// Walks from the lights, joined to the camera.
class LightPaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 2.0; }
    Paths paths(const Scene& scene) const override;
    void warn(const Scene& scene, Warnings& warnings) const override;
    bool splats() const override { return true; }
    bool has_even_samples() const override { return true; }
    bool starts_at_camera() const override { return false; }
    bool starts_at_lights() const override { return true; }
    bool is_bounded(const SamplingSettings&) const override { return false; }
    bool is_boundless(std::size_t) const override { return true; }
    std::string why_no_history() const override { return "the paths of all pixels bring light to it"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::bidirectional}}; }

private:
    const char* unfound_in_mirrors() const override { return nullptr; }
};

// Subpaths from both ends, joined at every pair of vertices.
class BidirectionalPaths : public PathMethod {
public:
    enum class Quantities {
        terms,
        ways  // each way (s, t) to make bounce N: N + 2 weighted ones, and then N + 2 unweighted ones
    };
    explicit BidirectionalPaths(Quantities quantities = Quantities::terms) : quantities_(quantities) {}

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    std::size_t pictures(int bounces) const override {
        return PathMethod::pictures(bounces) * (quantities_ == Quantities::ways ? 2 : 1);
    }
    double walks_worth(int, std::span<const double>) const override { return 5.0; }
    bool splats() const override { return true; }
    bool starts_at_lights() const override { return true; }
    // The unweighted half of the ways is not bounded.
    bool is_bounded(const SamplingSettings&) const override { return quantities_ == Quantities::terms; }
    std::string why_no_history() const override { return "the paths of all pixels bring light to it"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool of_rest) const override {
        return of_rest ? std::vector{Remedy::more_bounces} : std::vector<Remedy>();
    }

private:
    const char* unfound_in_mirrors() const override;

    Quantities quantities_;
};

class SplatSampler : public PathSampler {
public:
    // `joined`: the quantities that subpaths from both ends make; none: all paths start at the lights.
    SplatSampler(const Scene& scene, const SamplingSettings& settings, std::optional<BidirectionalPaths::Quantities> joined);

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    bool has_own_samples() const override { return true; }
    std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const override;
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;

private:
    struct Workspace;
    struct Chunk;
    // Traces paths first … first + samples − 1 of the replicate. `found(path, quantity, value)`: a contribution to the path's own
    // pixel, before the filter's weight. `splatted(path, position, quantity, value)`: a contribution at a position on the film, as
    // radiance times the number of pixels.
    template <class OnFound, class OnSplat, class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, const OnFound& found,
                     const OnSplat& splatted, Workspace& work, const Observer& observer = {}) const;
    // Traces paths into work.group.samples, without the filters' weights, and into the chunk.
    void sample_paths(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk, Workspace& work) const;
    void sample_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk, std::span<Rgb> own,
                      SampleRanges& ranges, Workspace& work) const;

    std::optional<BidirectionalPaths::Quantities> joined_;
    std::uint32_t pixels_;
    EmissionSampler emission_;
    Bidirectional bidirectional_;
    SobolPoints light_points_;
};

}  // namespace neumann
