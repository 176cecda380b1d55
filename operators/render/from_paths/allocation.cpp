#include "operators/render/from_paths/allocation.h"

#include "operators/render/from_paths/picture_sampler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint32_t block_width = 8, samples_of_pilot = 4;
constexpr std::uint64_t allocation_stream = 0x414c4c4f43504c54ULL;
// A pixel has at most 2^most_doublings times the mean number of samples, and at least the mean divided by that.
constexpr int most_doublings = 4;
// This part of the variance is spread over all blocks, because rare light that the pilot did not meet may be anywhere.
constexpr double spread_out = 0.1;

// For each pixel and quantity, the variance of its samples and their squared mean, each summed over channels.
struct PixelSpread {
    std::vector<double> variance, square;  // bounces 0 … N and the sum of all, pixel by pixel
};
PixelSpread spread_of(std::span<const Rgb> samples, std::size_t pixels, std::size_t size, std::size_t quantities) {
    const std::size_t terms = quantities - 1;  // without the rest
    PixelSpread found{std::vector<double>(pixels * quantities, 0.0), std::vector<double>(pixels * quantities, 0.0)};
    const auto n = static_cast<double>(size);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t q = 0; q < quantities; ++q) {
            Rgb sum(0.0), squares(0.0);
            for (std::size_t i = 0; i < size; ++i) {
                const Rgb* const of = &samples[(pixel * size + i) * quantities];
                const Rgb x = q < terms ? of[q] : std::accumulate(of, of + terms, Rgb(0.0));
                sum += x;
                squares += x * x;
            }
            const Rgb mean = sum / n, variance = (squares - sum * mean) / (n - 1.0);
            // This is an unbiased estimate of the squared mean; its noise in dark pixels cancels over the picture.
            const Rgb square = mean * mean - variance / n;
            found.variance[pixel * quantities + q] = std::max(variance.r + variance.g + variance.b, 0.0);
            found.square[pixel * quantities + q] = square.r + square.g + square.b;
        }
    return found;
}

}  // namespace

std::vector<double> best_numbers(const BlockCosts& all, LeastError least) {
    const std::size_t K = all.errors(), B = all.blocks, bounces = least.of == LeastError::Of::all ? K - 1 : K;
    const auto normalised = [](std::vector<double> weights) {
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        for (double& w : weights) w /= sum;
        return weights;
    };
    std::vector<double> weights(K, 1.0 / static_cast<double>(K)), numbers(B, 1.0), best = numbers;
    std::vector<double> of_largest(bounces, 1.0 / static_cast<double>(bounces));
    const double budget = std::accumulate(all.costs.begin(), all.costs.end(), 0.0);
    double smallest = std::numeric_limits<double>::infinity();
    for (int step = 0; step < (K == 1 ? 1 : 200); ++step) {
        double cost = 0.0;
        for (std::size_t b = 0; b < B; ++b) {
            double v = 0.0;
            for (std::size_t k = 0; k < K; ++k) v += weights[k] * all.variance(k)[b];
            numbers[b] = std::sqrt(v / all.costs[b]);
            cost += numbers[b] * all.costs[b];
        }
        if (!(cost > 0.0)) return std::vector<double>(B, 1.0);
        for (double& s : numbers) s *= budget / cost;
        std::vector<double> errors(K, 0.0);
        for (std::size_t k = 0; k < K; ++k)
            for (std::size_t b = 0; b < B; ++b)
                if (all.variance(k)[b] > 0.0) errors[k] += all.variance(k)[b] / numbers[b];
        const double largest = *std::max_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(bounces));
        double size = std::log(largest);
        if (least.of == LeastError::Of::all)
            for (const double e : errors) size += std::log(e) / static_cast<double>(K);
        if (size < smallest) {
            smallest = size;
            best = numbers;
        }
        for (std::size_t k = 0; k < bounces; ++k) of_largest[k] *= std::sqrt(errors[k] / largest);
        of_largest = normalised(of_largest);
        if (least.of != LeastError::Of::all) {
            weights = of_largest;
            continue;
        }
        std::vector<double> wanted(K);
        for (std::size_t k = 0; k < K; ++k)
            wanted[k] = 1.0 / (static_cast<double>(K) * errors[k]) + (k < bounces ? of_largest[k] / largest : 0.0);
        wanted = normalised(wanted);
        for (std::size_t k = 0; k < K; ++k) weights[k] = std::sqrt(weights[k] * wanted[k]);
        weights = normalised(weights);
    }
    return best;
}

std::vector<std::int8_t> as_powers(const std::vector<double>& numbers, std::span<const double> costs, double budget, int most,
                                   Below below) {
    const auto power = [&](double number) -> std::int8_t {
        const double k = number > 0.0 ? std::round(std::log2(number)) : -std::numeric_limits<double>::infinity();
        if (k < -most && below == Below::none) return Allocation::none;
        return static_cast<std::int8_t>(std::clamp<double>(k, -most, most));
    };
    const auto powers = [&](double scale) {
        std::vector<std::int8_t> all;
        for (const double s : numbers) all.push_back(power(scale * s));
        return all;
    };
    const auto cost = [&](const std::vector<std::int8_t>& all) {
        double sum = 0.0;
        for (std::size_t b = 0; b < all.size(); ++b) sum += costs[b] * Allocation::times(all[b]);
        return sum;
    };
    double low = std::exp2(-2.0 * most), high = std::exp2(2.0 * most);
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(low * high);
        (cost(powers(middle)) <= budget ? low : high) = middle;
    }
    return powers(low);
}

std::shared_ptr<const Allocation> allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                           const Watch& watch) {
    SamplingSettings of_pilot = settings;
    of_pilot.allocation = {};
    of_pilot.colors = {};
    of_pilot.seed = allocation_stream;
    of_pilot.replicate_size = samples_of_pilot;
    of_pilot.walk.rest_probability = 0.0;
    const PictureSampler sampler(scene, of_pilot);
    const std::size_t Q = sampler.quantities(), terms = Q - 1;
    const auto width = static_cast<std::uint32_t>(sampler.width()), height = static_cast<std::uint32_t>(sampler.height()),
               across = (width + block_width - 1) / block_width, down = (height + block_width - 1) / block_width;
    const SampleLayout& layout = sampler.layout();
    std::vector<double> variance(layout.pixels() * Q), square = variance, cost(layout.pixels());
    std::atomic<std::uint64_t> all_rays = 0;
    const OwnSamples measure = [&](const PixelGroup& group, std::span<const Rgb> samples, std::span<const std::uint64_t> rays) {
        const PixelSpread spread = spread_of(samples, group.end - group.begin, group.size, Q);
        std::ranges::copy(spread.variance, variance.begin() + static_cast<std::ptrdiff_t>(group.begin * Q));
        std::ranges::copy(spread.square, square.begin() + static_cast<std::ptrdiff_t>(group.begin * Q));
        const std::uint64_t n = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
        all_rays += n;
        for (std::uint32_t pixel = group.begin; pixel < group.end; ++pixel) cost[pixel] = static_cast<double>(n) / group.paths();
    };
    const std::optional<std::uint64_t> shared = sampler.path_sampler().own_samples(0, measure, watch);
    if (!shared) throw Stopped();

    BlockCosts blocks{across * down, {}, std::vector<double>(across * down, 0.0)};
    const auto block_of = [&](std::uint32_t pixel) { return pixel / width / block_width * across + pixel % width / block_width; };
    for (std::uint32_t pixel = 0; pixel < layout.pixels(); ++pixel) blocks.costs[block_of(pixel)] += cost[pixel];
    const auto add = [&](std::size_t q) {
        std::vector<double> of_blocks(blocks.blocks, 0.0);
        double size = 0.0, sum = 0.0;
        for (std::uint32_t pixel = 0; pixel < layout.pixels(); ++pixel) {
            of_blocks[block_of(pixel)] += variance[pixel * Q + q];
            size += square[pixel * Q + q];
            sum += variance[pixel * Q + q];
        }
        if (!(size > 0.0) || !(sum > 0.0) || !std::isfinite(sum)) return false;
        const double everywhere = spread_out * sum / static_cast<double>(blocks.blocks);
        for (const double v : of_blocks) blocks.variances.push_back(((1.0 - spread_out) * v + everywhere) / size);
        return true;
    };
    if (least.bounce) {
        add(static_cast<std::size_t>(*least.bounce));
    } else {
        if (least != LeastError::of_sum)
            for (std::size_t q = 0; q < terms; ++q) add(q);
        const bool has_bounces = !blocks.variances.empty(), has_sum = least != LeastError::of_bounces && add(terms);
        if (least == LeastError::of_all && !(has_bounces && has_sum)) least = has_sum ? LeastError::of_sum : LeastError::of_bounces;
    }
    Allocation allocation{std::vector<std::int8_t>(layout.pixels(), 0), all_rays + *shared};
    if (blocks.variances.empty()) return std::make_shared<const Allocation>(std::move(allocation));
    const std::vector<std::int8_t> powers = as_powers(
        best_numbers(blocks, least), blocks.costs, std::accumulate(blocks.costs.begin(), blocks.costs.end(), 0.0), most_doublings);
    for (std::uint32_t pixel = 0; pixel < layout.pixels(); ++pixel) allocation.exponents[pixel] = powers[block_of(pixel)];
    return std::make_shared<const Allocation>(std::move(allocation));
}

}  // namespace neumann
