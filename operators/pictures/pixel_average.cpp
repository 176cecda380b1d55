#include "operators/pictures/pixel_average.h"

#include <algorithm>

namespace neumann {

namespace {

// Records the samples of one quantity that are not finite, sets them to zero, and returns the sum of the others.
Rgb leave_out_non_finite(std::span<Rgb> samples, std::size_t size, std::size_t q, std::size_t quantities, std::uint32_t pixel,
                         std::uint64_t replicate, Tally& tally) {
    Rgb sum(0.0);
    for (std::size_t i = 0; i < size; ++i) {
        Rgb& x = samples[i * quantities + q];
        if (!is_finite(x)) {
            tally.keep({static_cast<int>(q), {pixel, {pixel, replicate * size + i}}});
            x = Rgb(0.0);
        }
        sum += x;
    }
    return sum;
}

}  // namespace

void average(std::span<Rgb> samples, std::size_t size, std::uint32_t pixel, std::uint64_t replicate, bool has_negative_samples,
             const std::optional<glm::dmat3>& colors, std::span<Rgb> mean, std::span<SampleRange> ranges, Tally& tally) {
    const std::size_t quantities = mean.size();
    std::copy_n(samples.begin(), quantities, mean.begin());
    for (std::size_t i = 1; i < size; ++i)
        for (std::size_t q = 0; q < quantities; ++q) mean[q] += samples[i * quantities + q];
    for (std::size_t q = 0; q < quantities; ++q) {
        Rgb& sum = mean[q];
        LargestSamples& largest = tally.largest[q];
        largest.add_count(size);
        if (!is_finite(sum)) [[unlikely]]
            sum = leave_out_non_finite(samples, size, q, quantities, pixel, replicate, tally);
        // If no sample is negative, none exceeds the sum.
        if (has_negative_samples || max_component(sum) > largest.threshold())
            for (std::size_t i = 0; i < size; ++i)
                largest.add(max_component(glm::abs(samples[i * quantities + q])), {pixel, {pixel, replicate * size + i}});
        for (std::size_t i = 0; i < size; ++i) ranges[q].add(samples[i * quantities + q]);
        sum *= 1.0 / static_cast<double>(size);
        if (colors) sum = *colors * sum;
    }
}

}  // namespace neumann
