#include "operators/render/report/health.h"

#include <algorithm>

namespace neumann {

namespace {

// With few samples, even ordinary ones make half of a dark pixel. A sample that is no outlier contributes less than the
// picture's mean to its pixel once there are this many samples.
constexpr double samples_of_ordinary_noise = 256.0;

// The share of one sample's value in the sum of a pixel's samples, which is `samples` times the mean.
double share(double value, double samples, const Rgb& mean) {
    const double all = samples * max_component(mean);
    return all > 0.0 ? value / all : 0.0;
}

std::uint64_t sum(const std::vector<SampleHealth>& bounces, std::uint64_t SampleHealth::*part) {
    std::uint64_t n = 0;
    for (const SampleHealth& bounce : bounces) n += bounce.*part;
    return n;
}

}  // namespace

std::uint64_t Health::non_finite() const { return sum(bounces, &SampleHealth::non_finite); }
std::uint64_t Health::overflowed() const { return sum(bounces, &SampleHealth::overflowed); }
std::uint64_t Health::fireflies() const { return sum(bounces, &SampleHealth::fireflies); }

bool Health::is_sick() const {
    if (non_finite() > 0 || overflowed() > 0 || fireflies() > 0) return true;
    if (!checkup) return false;
    return checkup->self_hits > 0 || (checkup->camera && checkup->camera->is_sick()) ||
           (checkup->light && checkup->light->is_sick());
}

Health examine(const Scene& scene, const SamplingSettings& settings, const RenderedSeries& series,
               const SeriesMoments::Result& result) {
    Health health;
    const std::size_t quantities = result.quantities(), pixels = result.pixels();
    const SampleLayout layout = settings.layout(scene.film);
    double mean = 0.0;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
        mean += max_component(result.sum_at(pixel, quantities - 1)) / static_cast<double>(pixels);
    for (std::size_t q = 0; q < quantities; ++q) {
        SampleHealth& bounce = health.bounces.emplace_back();
        bounce.non_finite = series.tally.non_finite_count[q];
        double brightest = 0.0;
        for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
            const Rgb term = result.term_at(pixel, q);
            brightest = std::max(brightest, max_component(term));
            if (is_finite(term)) continue;
            if (bounce.overflowed++ == 0) bounce.first_overflowed = pixel;
        }
        for (const LargestSamples::Sample& sample : series.tally.largest[q].standing_out()) {
            const std::uint32_t pixel = sample.place.pixel;
            // All pixels have equally many paths from lights.
            const double part = sample.place.name.pixel == pixel
                                    ? static_cast<double>(layout.size(pixel)) / static_cast<double>(series.replicate_size)
                                    : 1.0,
                         samples = static_cast<double>(series.samples) * part;
            const LargestShare found{sample, share(sample.value, samples, result.term_at(pixel, q)),
                                     share(sample.value, samples, result.sum_at(pixel, quantities - 1))};
            const bool firefly = q > 0 && series.samples >= fewest_samples_to_judge && found.of_sum > 0.5 &&
                                 sample.value > std::max(samples, samples_of_ordinary_noise) * mean &&
                                 sample.value > 0.25 * samples * brightest;
            if (firefly ? bounce.fireflies == 0 || found.of_sum > bounce.largest->of_sum
                        : bounce.fireflies == 0 && (!bounce.largest || found.of_bounce > bounce.largest->of_bounce))
                bounce.largest = found;
            bounce.fireflies += firefly;
        }
    }
    const PictureSampler sampler(scene, settings);
    for (std::size_t q = 0; q < quantities; ++q)
        // Merged renders have several seeds.
        if (SampleHealth& bounce = health.bounces[q]; bounce.fireflies > 0 && series.merged.empty())
            bounce.remedies = remedies(scene, sampler, bounce.largest->sample.place.name, q);
    health.first_non_finite = series.tally.non_finite;
    const std::uint64_t of_this_seed =
        series.merged.empty() ? series.samples : series.merged.front().count * std::uint64_t{series.replicate_size};
    health.checkup = check_up(scene, sampler, of_this_seed);
    health.why_no_checkup = settings.method->why_no_checkup();
    health.why_no_balance = settings.method->why_no_balance();
    return health;
}

}  // namespace neumann
