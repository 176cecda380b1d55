#include "operators/render/from_paths/term_estimators.h"

#include "operators/render/from_paths/pixel_groups.h"
#include "operators/render/from_paths/pixel_samples.h"

namespace neumann {

namespace {

struct PictureWork {
    explicit PictureWork(std::size_t quantities) : average(quantities), tally(quantities) {}
    PathGroup group;
    PixelSamples samples;
    PixelAverage average;
    Tally tally;
};

}  // namespace

bool EstimatorSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                      const Watch& watch) const {
    return sample_groups<PictureWork>(
        settings_, layout_, replicate, picture, ranges, tally, watch, [&](const PixelGroup& pixels, PictureWork& work) {
            work.samples.begin(scene_->film, settings_, layout_, pixels);
            work.tally.given_up +=
                trace(*scene_, *estimator_, std::span(work.samples.samplers), std::span<const Pixel>(work.samples.pixels),
                      replicate, work.group, std::span(work.tally.rays));
        });
}

std::optional<std::uint64_t> EstimatorSampler::own_samples(std::uint64_t replicate, const OwnSamples& each,
                                                           const Watch& watch) const {
    const bool done = for_groups(layout_, watch, [&](const PixelGroup& pixels) {
        std::vector<std::uint64_t> rays(settings_.quantities());
        PixelSamples samples;
        samples.begin(scene_->film, settings_, layout_, pixels);
        PathGroup paths;
        trace(*scene_, *estimator_, std::span(samples.samplers), std::span<const Pixel>(samples.pixels), replicate, paths,
              std::span(rays));
        each(pixels, paths.samples, rays);
    });
    return done ? std::optional<std::uint64_t>(0) : std::nullopt;
}

}  // namespace neumann
