// Samples the terms over a whole picture, replicate by replicate, and keeps the moments of every term and sum.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/pictures/corrected_sampler.h"
#include "operators/pictures/splat_sampler.h"
#include "operators/pictures/tally.h"
#include "operators/pictures/term_estimators.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <cstdint>
#include <optional>
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

    // Samples replicates first … first + count − 1 of every pixel; count is a power of two that divides first. Adds to `tally`,
    // which holds the earlier replicates, unless `watch` stops it: then the work is dropped. watch.progress gets the fraction of
    // these replicates that is done. `memory` is reused for the node: fresh pages for every block would cost as much as the
    // moments themselves.
    std::optional<MomentsNode> run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch = {},
                                   std::vector<double> memory = {}) const;

    // Traces one group of paths of run() again (path_group.h) and reports it to `observer`; `first` is the first path of the group.
    // Returns the samples, path by path with all quantities, with the same bits as in run(); the plan leaves nothing out.
    // The pointwise method has no paths: std::logic_error.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const;

private:
    const Scene& scene_;
    Settings settings_;
    std::variant<TermEstimator, SplatSampler, CorrectedSampler> sampler_;
    SobolPoints sobol_;
};

}  // namespace neumann
