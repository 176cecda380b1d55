#include "operators/render/from_paths/mixture_trial.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t mixture_stream = 0x4d49585455524553ULL;

SamplingSettings settings_of_trial(SamplingSettings settings, std::uint32_t size) {
    settings.colors = {};
    settings.seed = mixture_stream;
    settings.replicate_size = size;
    settings.walk.rest_probability = 0.0;
    return settings;
}

}  // namespace

MixtureTrial::MixtureTrial(const Scene& view, const SamplingSettings& settings, std::uint32_t size, const Watch& watch)
    : sampler_(view, settings_of_trial(settings, size)),
      sums_(pixels() * sampler_.quantities(), Rgb(0.0)),
      squares_(sums_),
      sum_of_means_(sampler_.quantities(), 0.0),
      of_squares_(sum_of_means_),
      rays_of_sample_(pixels(), 0.0) {
    if (!sampler_.path_sampler().has_own_samples()) return;  // go_on() counts the rays
    std::atomic<std::uint64_t> all = 0;
    const OwnSamples count = [&](const PixelGroup& group, std::span<const Rgb>, std::span<const std::uint64_t> rays) {
        const std::uint64_t n = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
        all += n;
        for (std::uint32_t pixel = group.begin; pixel < group.end; ++pixel)
            rays_of_sample_[pixel] = static_cast<double>(n) / group.paths();
    };
    const std::optional<std::uint64_t> shared = sampler_.path_sampler().own_samples(0, count, watch);
    if (!shared) throw Stopped();
    rays_ = all + *shared;
}

void MixtureTrial::go_on(std::uint32_t replicates, const Watch& watch) {
    const std::size_t Q = sampler_.quantities();
    Tally tally(Q);
    for (std::uint32_t r = 0; r < replicates; ++r) {
        std::vector<Rgb> picture(sums_.size(), Rgb(0.0));
        SampleRanges ranges;
        ranges.of.resize(picture.size());
        if (!sampler_.path_sampler().sample_picture(static_cast<std::uint64_t>(replicates_), picture, ranges, tally, watch))
            throw Stopped();
        std::vector<double> means(Q, 0.0);
        for (std::size_t i = 0; i < picture.size(); ++i) {
            sums_[i] += picture[i];
            squares_[i] += picture[i] * picture[i];
            means[i % Q] += picture[i].r + picture[i].g + picture[i].b;
        }
        for (std::size_t q = 0; q < Q; ++q) {
            sum_of_means_[q] += means[q];
            of_squares_[q] += means[q] * means[q];
        }
        replicates_ += 1.0;
    }
    rays_ += std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0});
    if (!sampler_.path_sampler().has_own_samples())
        std::ranges::fill(rays_of_sample_, static_cast<double>(rays_) / (samples() * pixels()));
}

Rgb MixtureTrial::variance(std::uint32_t pixel, std::size_t bounce) const {
    const Rgb m = mean(pixel, bounce), spread = squares_[at(pixel, bounce)] / replicates_ - m * m;
    return glm::max(spread, Rgb(0.0)) * (samples() / (replicates_ - 1.0));
}

double MixtureTrial::sure_mean(std::size_t bounce) const {
    const double m = sum_of_means_[bounce] / replicates_, spread = std::max(of_squares_[bounce] / replicates_ - m * m, 0.0);
    return m - 2.0 * std::sqrt(spread / (replicates_ - 1.0));
}

}  // namespace neumann
