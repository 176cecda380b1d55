// Samples the terms by Metropolis light transport (operators/paths/metropolis), with chains for each bounce, since each term is a
// bounce. A replicate is a whole picture and has its own independent paths, from which its own chains start, so that replicates are
// independent of each other. Bounce 0 is sampled by camera rays, and the rest by the independent paths.
//
// Mutation j of a replicate belongs to one chain of each bounce: path j % 64 of step (j / 64) % length of batch j / 64
// / length. It shares its name with camera ray j, for bounce 0, and independent path j, for the rest.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/metropolis/chain_batch.h"
#include "operators/render/from_paths/path_sampler.h"

#include <optional>
#include <vector>

namespace neumann {

// The number of chains of each bounce in a replicate, and of states of a chain, the first included.
struct ChainNumbers {
    std::uint32_t chains = 0, length = 0;
    std::uint64_t states() const { return std::uint64_t{chains} * length; }
};
// `states`: the most states of each bounce; `length`: states of a chain, if there are enough for chains_at_once chains.
ChainNumbers chain_numbers(std::uint64_t states, std::uint32_t length);

class MetropolisPaths : public PathMethod {
public:
    static constexpr std::uint32_t default_length = 512;
    // `length`: states of a chain, if there are enough.
    explicit MetropolisPaths(std::uint32_t length = default_length) : length_(length) {}
    std::uint32_t length() const { return length_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    // The ratio follows from the rays: k + 1 for bounce k = 1 … N, and half an independent path.
    double walks_worth(int bounces, std::span<const double>) const override { return 1.25 + 0.375 * bounces; }
    bool has_even_samples() const override { return true; }
    bool starts_at_lights() const override { return true; }
    bool is_bounded(const SamplingSettings&) const override { return false; }
    bool has_chains() const override { return true; }
    std::string why_no_history() const override { return "the paths of all pixels bring light to it"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::bidirectional}}; }

private:
    const char* unfound_in_mirrors() const override { return unfound_from_both_ends; }

    std::uint32_t length_;
};

class MetropolisSampler : public PathSampler {
public:
    MetropolisSampler(const Scene& scene, const SamplingSettings& settings, std::uint32_t length);

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    // Runs the chains of this group again, and traces all independent paths.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;
    // Inspects the independent paths, from which chains start.
    std::unique_ptr<const PathsToInspect> to_inspect() const override;

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
    // Finds the starts of chains first_chain … end_chain − 1.
    Starts find_starts(std::uint64_t replicate, const BrightnessSums& sums, std::uint32_t first_chain, std::uint32_t end_chain,
                       std::vector<std::uint64_t>& rays) const;
    std::vector<Sampler> random_of(int bounce, std::uint32_t batch) const;

    std::uint32_t pixels_;
    ChainNumbers numbers_;
    IndependentPaths independent_;
    Bidirectional of_chains_;
};

}  // namespace neumann
