#include "operators/render/from_paths/pixel_average.h"

#include "core/base/hot.h"

#include <algorithm>

namespace neumann {

namespace {

// Records the samples of one quantity that are not finite, and sets them to zero.
void leave_out_non_finite(std::span<Rgb> samples, std::size_t size, std::size_t q, std::size_t quantities, std::uint32_t pixel,
                          std::uint64_t replicate, Tally& tally) {
    for (std::size_t i = 0; i < size; ++i) {
        Rgb& x = samples[i * quantities + q];
        if (is_finite(x)) continue;
        tally.keep({static_cast<int>(q), {pixel, {pixel, replicate * size + i}}});
        x = Rgb(0.0);
    }
}

// The sums, the smallest and the largest of `size` samples, each of n numbers.
NEUMANN_HOT void add_up(const double* samples, std::size_t size, std::size_t n, double* __restrict sum, double* __restrict low,
                        double* __restrict high) {
    for (std::size_t k = 0; k < n; ++k) sum[k] = low[k] = high[k] = samples[k];
    for (std::size_t i = 1; i < size; ++i)
        for (std::size_t k = 0; k < n; ++k) {
            const double x = samples[i * n + k];
            sum[k] += x;
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
}

}  // namespace

void average(std::span<Rgb> samples, std::size_t size, std::uint32_t pixel, std::uint64_t replicate,
             const std::optional<glm::dmat3>& colors, PixelAverage& average, std::span<SampleRange> ranges, Tally& tally) {
    auto& [mean, low, high] = average;
    const std::size_t quantities = mean.size();
    const auto all = [&, &sum = mean, &least = low, &most = high] {
        add_up(&samples[0].x, size, 3 * quantities, &sum[0].x, &least[0].x, &most[0].x);
    };
    all();
    if (!std::ranges::all_of(mean, [](const Rgb& sum) { return is_finite(sum); })) [[unlikely]] {
        for (std::size_t q = 0; q < quantities; ++q)
            if (!is_finite(mean[q])) leave_out_non_finite(samples, size, q, quantities, pixel, replicate, tally);
        all();
    }
    for (std::size_t q = 0; q < quantities; ++q) {
        LargestSamples& largest = tally.largest[q];
        largest.add_count(size);
        if (max_component(glm::max(glm::abs(low[q]), glm::abs(high[q]))) > largest.threshold())
            for (std::size_t i = 0; i < size; ++i)
                largest.add(max_component(glm::abs(samples[i * quantities + q])), {pixel, {pixel, replicate * size + i}});
        ranges[q].add(low[q]);
        ranges[q].add(high[q]);
        mean[q] *= 1.0 / static_cast<double>(size);
        if (colors) mean[q] = *colors * mean[q];
    }
}

}  // namespace neumann
