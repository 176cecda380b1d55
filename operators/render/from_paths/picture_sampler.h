// Samples the terms over a whole picture, replicate by replicate, and keeps the moments of every term and sum.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/from_paths/metropolis_sampler.h"
#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/from_paths/own_samples.h"
#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/from_paths/pixel_samples.h"
#include "operators/render/from_paths/share.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/from_paths/tally.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace neumann {

class PictureSampler {
public:
    using Settings = SamplingSettings;

    PictureSampler(const Scene& scene, const Settings& settings);

    int width() const { return scene_.film.crop_width; }
    int height() const { return scene_.film.crop_height; }
    std::size_t quantities() const { return settings_.quantities(); }
    const Settings& settings() const { return settings_; }
    const SampleLayout& layout() const { return layout_; }

    // Samples replicates first … first + count − 1 of every pixel; count is a power of two that divides first. Adds to `tally`,
    // which holds the earlier replicates, unless `watch` stops it: then the work is dropped. watch.progress gets the fraction of
    // these replicates that is done. `memory` is reused for the node: fresh pages for every block would cost as much as the
    // moments themselves.
    std::optional<MomentsNode> run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch = {},
                                   std::vector<double> memory = {}) const;

    // The same node in shares: of pixels, about as many as `pieces`, or of whole pictures.
    std::vector<Share> shares(std::uint64_t first, std::uint64_t count, std::uint32_t pieces) const;
    // Samples one of them. `tally` holds earlier replicates: what it makes unnecessary is not kept. Nothing if `watch` stopped it.
    std::optional<SampledShare> sample(const Share& share, const Tally& tally, const Watch& watch = {}) const;
    // The node again; `next` is asked for each of its shares in turn.
    std::optional<MomentsNode> join(std::uint64_t first, std::uint64_t count, std::uint32_t pieces, Tally& tally,
                                    const std::function<std::optional<SampledShare>(const Share&)>& next,
                                    std::vector<double> memory = {}) const;

    // Traces one group of paths of run() again (path_group.h) and reports it to `observer`; `first` is the first path of the group.
    // Returns the samples, path by path with all quantities, with the same bits as in run(); the plan leaves nothing out.
    // The pointwise method has no paths: std::logic_error.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const;

    // The samples of all pixels without what paths from the lights bring to pixels all over the film. For methods of which pixels
    // may have different numbers of samples. Returns the rays cast for what pixels share; nothing if `watch` stopped it.
    std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch = {}) const;

    // Adds the picture of one replicate, all quantities of each pixel, black where a pixel has no samples. False if `watch` stopped
    // it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch = {}) const;

    // Null unless several methods are mixed.
    const MixedSampler* mixed() const { return std::get_if<MixedSampler>(&sampler_); }
    // Null unless paths are chains.
    const MetropolisSampler* metropolis() const { return std::get_if<MetropolisSampler>(&sampler_); }
    const CorrectedSampler* corrected() const { return std::get_if<CorrectedSampler>(&sampler_); }

    // With photon maps: traces the paths again that left photons of a replicate, those of the group with this path, which have
    // their numbers in the group. With a cache: the ray of a record with this number, which has number 0.
    void retrace_read(std::uint64_t replicate, std::uint32_t path, PathObserver& observer) const;

private:
    std::uint32_t pixels() const { return static_cast<std::uint32_t>(width()) * static_cast<std::uint32_t>(height()); }
    // Whether its pixels share something.
    bool has_whole_pictures() const { return settings_.shares_tails() || !std::holds_alternative<TermEstimator>(sampler_); }
    MomentsNode empty_node(std::uint64_t first, std::uint64_t count, std::vector<double> memory) const;
    // sample(replicate, picture, ranges, tally, watch), for each replicate in turn.
    template <class Sample>
    std::optional<MomentsNode> join_pictures(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                             std::vector<double> memory, const Sample& sample) const;
    // Samples pixels of replicates; data and ranges are of these pixels. Whether it was not stopped.
    bool sample_pixels(const Share& share, std::span<double> data, std::span<SampleRange> ranges, Tally& tally,
                       const Watch& watch) const;

    const Scene& scene_;
    Settings settings_;
    SampleLayout layout_;
    std::variant<TermEstimator, SplatSampler, CorrectedSampler, PhotonSampler, CacheSampler, MetropolisSampler, MixedSampler>
        sampler_;
};

}  // namespace neumann
