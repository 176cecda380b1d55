// Samples the terms over a whole picture by any method, replicate by replicate, and keeps the moments of every term and sum.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/path_sampler.h"
#include "operators/render/from_paths/share.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
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
    const PathSampler& path_sampler() const { return *paths_; }

    // Samples replicates first … first + count − 1 of every pixel; count is a power of two that divides first. Adds to
    // `tally`, which holds the earlier replicates, unless `watch` stops it: then the work is dropped. watch.progress
    // gets the finished fraction of these replicates. `memory` is reused for the node: fresh pages for every block
    // would cost as much as the moments themselves.
    std::optional<MomentsNode> run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch = {},
                                   std::vector<double> memory = {}) const;

    // The same node in shares: of pixels, about as many as `pieces`, or of whole pictures.
    std::vector<Share> shares(std::uint64_t first, std::uint64_t count, std::uint32_t pieces) const;
    // Samples one share, without keeping samples too small for `tally`, which holds earlier replicates. Nothing if stopped.
    std::optional<SampledShare> sample(const Share& share, const Tally& tally, const Watch& watch = {}) const;
    // The node, joined from shares; `next` is called for each of them in turn.
    std::optional<MomentsNode> join(std::uint64_t first, std::uint64_t count, std::uint32_t pieces, Tally& tally,
                                    const std::function<std::optional<SampledShare>(const Share&)>& next,
                                    std::vector<double> memory = {}) const;

private:
    std::uint32_t pixels() const { return static_cast<std::uint32_t>(width()) * static_cast<std::uint32_t>(height()); }
    // Whether a replicate is sampled as a whole picture, because its pixels share something.
    bool has_whole_pictures() const { return paths_->of_pixels() == nullptr; }
    MomentsNode empty_node(std::uint64_t first, std::uint64_t count, std::vector<double> memory) const;
    // Calls sample(replicate, picture, ranges, tally, watch) for each replicate in turn.
    template <class Sample>
    std::optional<MomentsNode> join_pictures(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                             std::vector<double> memory, const Sample& sample) const;
    // Samples pixels of replicates into `data` and `ranges`, which hold these pixels only. False if it was stopped.
    bool sample_pixels(const Share& share, std::span<double> data, std::span<SampleRange> ranges, Tally& tally,
                       const Watch& watch) const;

    const Scene& scene_;
    Settings settings_;
    SampleLayout layout_;
    std::shared_ptr<const PathSampler> paths_;
};

}  // namespace neumann
