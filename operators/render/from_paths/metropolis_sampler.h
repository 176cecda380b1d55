// Samples the terms by Metropolis light transport (operators/paths/metropolis): chains for each bounce, for that is what a term is. A
// replicate is a whole picture and has its own independent paths, from which its own chains start, so that replicates are
// independent of each other. Bounce 0 is sampled by camera rays, and the rest by the independent paths.
//
// Mutation j of a replicate is one of each bounce's chains: path j % 64 of step (j / 64) % length of batch j / 64 / length. It
// shares its name with camera ray j, for bounce 0, and independent path j, for the rest.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/metropolis/chain_batch.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <optional>
#include <vector>

namespace neumann {

// The chains of each bounce in a replicate, and the number of their states, the first included.
struct ChainNumbers {
    std::uint32_t chains = 0, length = 0;
    std::uint64_t states() const { return std::uint64_t{chains} * length; }
};
// `states`: at most so many of each bounce; `length`: of a chain, if there are enough states for chains_at_once chains.
ChainNumbers chain_numbers(std::uint64_t states, std::uint32_t length);

class MetropolisSampler {
public:
    // Keeps a reference to the scene.
    MetropolisSampler(const Scene& scene, const SamplingSettings& settings);

    // Adds a replicate's picture, all quantities of each pixel. Returns false if `watch` stopped it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const;
    // As PictureSampler::retrace(); runs the chains of these names again, and traces all independent paths.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const;

    // Traces a group of a replicate's independent paths again, which begins with number group · chains_at_once.
    void retrace_independent(std::uint64_t replicate, std::uint32_t group, PathObserver& observer) const;
    std::uint32_t independent_groups() const { return independent_.groups(); }
    std::uint32_t independent_paths_of(std::uint32_t group) const { return independent_.paths_of_group(group); }

private:
    struct Workspace;
    struct CameraWork;
    struct Piece;
    using Starts = std::vector<std::vector<ChainStart>>;  // by bounce and chain

    std::uint32_t batches() const { return (numbers_.chains + chains_at_once - 1) / chains_at_once; }
    std::uint32_t chains_of_batch(std::uint32_t batch) const {
        return std::min(chains_at_once, numbers_.chains - batch * chains_at_once);
    }
    SampleName name(std::uint64_t replicate, std::uint32_t number) const;

    template <class Observer = NoObserver>
    void trace_camera_rays(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, CameraWork& work,
                           const Observer& observer = {}) const;
    void sample_emission(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally) const;
    std::optional<BrightnessSums> sample_brightness(std::uint64_t replicate, std::vector<Rgb>& splatted, Tally& tally,
                                                    const Watch& watch) const;
    // Those of some chains.
    Starts find_starts(std::uint64_t replicate, const BrightnessSums& sums, std::uint32_t first_chain, std::uint32_t end_chain,
                       std::vector<std::uint64_t>& rays) const;
    std::vector<Sampler> random_of(int bounce, std::uint32_t batch) const;

    const Scene* scene_;
    SamplingSettings settings_;
    std::uint32_t pixels_;
    ChainNumbers numbers_;
    IndependentPaths independent_;
    Bidirectional of_chains_;
    SampleLayout layout_;
};

}  // namespace neumann
