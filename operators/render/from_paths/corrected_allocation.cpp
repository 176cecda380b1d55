// Distributes the parts of corrected samples by pilots, whose own samples are used for nothing else, so that the picture stays
// unbiased.
//
// A sample that ends with its light samples at the first diffuse vertex (corrected_walk.h) costs c_d rays, one that goes on
// from there c(G, C), with G directions and C of the shared points. With n of the latter in each pixel p, and n d_p of
// both, the relative squared error of bounce q, as a mean over pixels, and the cost are
//
//     E_q = (mean_p D_pq / d_p + B_q(G, C)) / n,     n (c(G, C) + c_d (mean_p d_p − 1))
//
// D and B are measured, B for a few G and C. D is large only at edges of lights, shadows and surfaces. d_p ∝ √D_p,
// the optimum at given cost. Its factor, G and C are those that make least the largest of these errors, or that of the sum or of a
// single bounce, or (of all) their mean, as long as neither a bounce nor the sum is worse than by walks of the same cost.
#include "operators/paths/corrected/shared_points.h"
#include "operators/render/from_paths/allocation.h"
#include "operators/render/from_paths/corrected_sampler.h"

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t parts_stream = 0x5041525453ull;
// Replicates by chance agree where an edge is parallel to the film: the fewer samples each has, the less often.
constexpr std::uint32_t samples_of_direct = 8, replicates_of_direct = 4, samples_of_parts = 16, replicates_of_parts = 2;
constexpr double most_pixels_of_parts = 512.0;
// About the rays of a sample, as a mean over `parts`.
constexpr double rays_of_parts = 14.0;
// G and C that are tried.
constexpr std::array<std::array<std::uint32_t, 2>, 6> parts{{{4, 1}, {8, 1}, {4, 2}, {8, 2}, {8, 4}, {16, 4}}};
// A pixel has at most 2^most_doublings_of_parts samples for each that goes on.
constexpr int most_doublings_of_parts = 8;
// The time of a ray of a walk beside one of these, and the power with which errors above those of walks count.
constexpr double price_of_ray_of_walk = 0.7, weight_of_walk = 4.0;
// Rare light that the pilot did not meet may be anywhere: this part of the variance is spread over all pixels.
constexpr double spread_of_parts = 0.05;
// Errors of a pixel are relative to its square and to this part of the squared mean of the picture, as relMSE has it.
constexpr double dark = 0.01;

// The pixels that a pilot samples.
struct SomePixels {
    std::vector<std::int8_t> exponents;  // as in Allocation, of all pixels
    std::vector<std::uint32_t> place;    // of all pixels: their place among those that are sampled
    std::size_t count = 0;

    explicit SomePixels(std::size_t pixels) : exponents(pixels, Allocation::none), place(pixels, 0) {}
    void add(std::size_t pixel) {
        exponents[pixel] = 0;
        place[pixel] = static_cast<std::uint32_t>(count++);
    }
};

SomePixels all_pixels(std::size_t pixels) {
    SomePixels all(pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) all.add(pixel);
    return all;
}

// A few, spread over the film.
SomePixels few_pixels(std::size_t width, std::size_t height) {
    const auto step = static_cast<std::size_t>(
        std::ceil(std::sqrt(static_cast<double>(width) * static_cast<double>(height) / most_pixels_of_parts)));
    SomePixels few(width * height);
    for (std::size_t j = 0; j * step < height; ++j)
        for (std::size_t i = 0; i * step < width; ++i) {
            const std::size_t x = i * step + (5 * i + 3 * j) % step, y = j * step + (3 * i + 7 * j) % step;
            if (x < width && y < height) few.add(y * width + x);
        }
    return few;
}

// Of each sampled pixel, for all bounces, their sum, and the sum of those after direct light: the mean and the variance of a
// sample, each summed over channels.
struct Spread {
    std::vector<double> mean, variance;
    double rays = 0.0;  // of a sample
};

class Pilots {
public:
    Pilots(std::shared_ptr<const Approximation> approximation, std::shared_ptr<const CausticAim> caustics, const Scene& scene,
           const SamplingSettings& settings, const Watch& watch)
        : scene_(scene),
          settings_(settings),
          watch_(watch),
          approximation_(std::move(approximation)),
          caustics_(std::move(caustics)),
          terms_(settings.quantities() - 1) {
        settings_.colors = {};
        settings_.seed = parts_stream;
        settings_.walk.rest_probability = 0.0;
    }

    std::uint64_t rays() const { return rays_; }

    // Of samples that all go on, with G directions and C points.
    Spread of_parts(const SomePixels& pixels, std::uint32_t directions, std::uint32_t points) {
        CorrectedAllocation allocation;
        allocation.first.directions = directions;
        allocation.first.points = points;
        const CorrectedSampler sampler = sampler_of(pixels, std::move(allocation), samples_of_parts);
        return measure(pixels, replicates_of_parts, [&](std::uint64_t replicate, const OwnSamples& add) {
            std::optional<CorrectedSampler::Shared>& shared = shared_[replicate];
            if (!shared) {
                std::vector<std::uint64_t> rays(settings_.quantities());
                std::uint64_t given_up = 0;
                shared = sampler.shared(replicate, nullptr, rays, given_up, watch_);
                if (!shared) return false;
                rays_ += std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
            }
            return sampler.own_samples(replicate, shared->points(), add, watch_);
        });
    }
    // Of samples none of which goes on.
    Spread of_direct(const SomePixels& pixels, bool with_rays, std::uint32_t replicates, std::uint32_t size) {
        CorrectedAllocation allocation;
        allocation.first.others_cast_rays = with_rays;
        allocation.going_on = Allocation::none;
        const CorrectedSampler sampler = sampler_of(pixels, std::move(allocation), size);
        return measure(pixels, replicates, [&](std::uint64_t replicate, const OwnSamples& add) {
            return sampler.own_samples(replicate, JoinedPoints(), add, watch_);
        });
    }
    Spread of_walk(const SomePixels& pixels) {
        settings_.replicate_size = samples_of_direct;
        settings_.allocation = std::make_shared<const Allocation>(pixels.exponents);
        const std::shared_ptr<const PathSampler> sampler = plain_walks()->sampler(scene_, settings_);
        return measure(pixels, replicates_of_direct, [&](std::uint64_t replicate, const OwnSamples& add) {
            return sampler->own_samples(replicate, add, watch_).has_value();
        });
    }

private:
    CorrectedSampler sampler_of(const SomePixels& pixels, CorrectedAllocation allocation, std::uint32_t size) {
        allocation.exponents = pixels.exponents;
        settings_.replicate_size = size;
        settings_.allocation = std::make_shared<const CorrectedAllocation>(std::move(allocation));
        return {scene_, settings_, approximation_, caustics_};
    }
    template <class Sample>
    Spread measure(const SomePixels& pixels, std::uint32_t replicates, const Sample& sample) {
        const std::size_t Q = terms_ + 2;
        std::vector<Rgb> sums(pixels.count * Q, Rgb(0.0)), squares = sums;
        std::atomic<std::uint64_t> cast = 0;
        for (std::uint64_t replicate = 0; replicate < replicates; ++replicate) {
            const OwnSamples add = [&](const PixelGroup& group, std::span<const Rgb> all, std::span<const std::uint64_t> rays) {
                std::vector<Rgb> means(Q);
                for (std::uint32_t pixel = group.begin; pixel < group.end; ++pixel) {
                    std::ranges::fill(means, Rgb(0.0));
                    for (std::uint32_t i = 0; i < group.size; ++i)
                        for (std::size_t q = 0; q < terms_; ++q) {
                            const Rgb x =
                                all[((pixel - group.begin) * group.size + i) * (terms_ + 1) + q] / static_cast<double>(group.size);
                            means[q] += x;
                            means[terms_] += x;
                            if (q > 1) means[terms_ + 1] += x;
                        }
                    for (std::size_t q = 0; q < Q; ++q) {
                        sums[pixels.place[pixel] * Q + q] += means[q];
                        squares[pixels.place[pixel] * Q + q] += means[q] * means[q];
                    }
                }
                cast += std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
            };
            if (!sample(replicate, add)) throw Stopped();
        }
        rays_ += cast;
        const double n = replicates, size = settings_.replicate_size;
        Spread found{std::vector<double>(sums.size()), std::vector<double>(sums.size()),
                     static_cast<double>(cast) / (n * size * static_cast<double>(pixels.count))};
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const Rgb mean = sums[k] / n, variance = (squares[k] - sums[k] * mean) / (n - 1.0);
            found.mean[k] = mean.r + mean.g + mean.b;
            found.variance[k] = size * std::max(variance.r + variance.g + variance.b, 0.0);
        }
        return found;
    }

    const Scene& scene_;
    SamplingSettings settings_;
    const Watch& watch_;
    std::shared_ptr<const Approximation> approximation_;
    std::shared_ptr<const CausticAim> caustics_;
    std::array<std::optional<CorrectedSampler::Shared>, replicates_of_parts> shared_;
    std::size_t terms_;
    std::uint64_t rays_ = 0;
};

// The mean of each pixel and its neighbours.
std::vector<double> smoothed(const std::vector<double>& x, std::size_t width) {
    const std::size_t height = x.size() / width;
    std::vector<double> smooth(x.size());
    for (std::size_t r = 0; r < height; ++r)
        for (std::size_t c = 0; c < width; ++c) {
            double sum = 0.0, count = 0.0;
            for (std::size_t j = r - std::min<std::size_t>(r, 1); j < std::min(r + 2, height); ++j)
                for (std::size_t i = c - std::min<std::size_t>(c, 1); i < std::min(c + 2, width); ++i, count += 1.0)
                    sum += x[j * width + i];
            smooth[r * width + c] = sum / count;
        }
    return smooth;
}

}  // namespace

double CorrectedPaths::rays_of_allocation(double pixels) {
    return std::min(pixels, most_pixels_of_parts) * samples_of_parts * replicates_of_parts * parts.size() * rays_of_parts +
           pixels * samples_of_direct * replicates_of_direct * 2.0;
}

std::shared_ptr<const Allocation> CorrectedPaths::allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                                           const Watch& watch) const {
    if (settings.walk.bounces < 2) return neumann::allocate(scene, settings, least, watch);
    const auto width = static_cast<std::size_t>(scene.film.crop_width), height = static_cast<std::size_t>(scene.film.crop_height),
               pixels = width * height, sum = settings.quantities() - 1, later = sum + 1, Q = sum + 2;
    Pilots pilots(approximation_, caustics_, scene, settings, watch);

    // B(G, C), in a few pixels.
    const SomePixels few = few_pixels(width, height);
    std::array<Spread, parts.size()> of_parts;
    std::vector<double> mean(few.count * Q, 0.0), of_picture(Q, 0.0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        of_parts[k] = pilots.of_parts(few, parts[k][0], parts[k][1]);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += of_parts[k].mean[i] / parts.size();
            of_picture[i % Q] += of_parts[k].mean[i] / static_cast<double>(parts.size() * few.count);
        }
    }
    // A variance as a part of the square of its pixel; what comes after direct light as a part of the sum's.
    const auto relative = [&](const Spread& spread, const std::vector<double>& means, std::size_t pixel, std::size_t q) {
        const std::size_t whole = q == later ? sum : q;
        const double m = means[pixel * Q + whole], square = m * m + dark * of_picture[whole] * of_picture[whole];
        return square > 0.0 ? spread.variance[pixel * Q + q] / square : 0.0;
    };
    const auto mean_in_few = [&](const Spread& spread) {
        std::vector<double> means(Q, 0.0);
        for (std::size_t pixel = 0; pixel < few.count; ++pixel)
            for (std::size_t q = 0; q < Q; ++q) means[q] += relative(spread, mean, pixel, q) / static_cast<double>(few.count);
        return means;
    };
    const Spread of_walk = pilots.of_walk(few);
    std::vector<double> by_walk = mean_in_few(of_walk);
    for (double& e : by_walk) e *= price_of_ray_of_walk * of_walk.rays;

    // D, with or without a ray for what it hits.
    const DirectLight way = settings.walk.direct.direct;
    bool with_rays = way == DirectLight::bsdf;
    Spread of_few = pilots.of_direct(few, with_rays, replicates_of_parts, samples_of_parts);
    if (way == DirectLight::mis) {
        Spread other = pilots.of_direct(few, true, replicates_of_parts, samples_of_parts);
        with_rays = other.rays * mean_in_few(other)[1] < of_few.rays * mean_in_few(of_few)[1];
        if (with_rays) of_few = std::move(other);
    }
    const std::vector<double> direct_in_few = mean_in_few(of_few);
    std::array<std::vector<double>, parts.size()> B;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        B[k] = mean_in_few(of_parts[k]);
        for (std::size_t q = 0; q < Q; ++q) B[k][q] = q < 2 ? 0.0 : std::max(B[k][q] - direct_in_few[q], 0.0);
        B[k][sum] = B[k][later];
    }
    const Spread of_direct = pilots.of_direct(all_pixels(pixels), with_rays, replicates_of_direct, samples_of_direct);
    // Of each quantity by itself. Neighbours share their noise, since that of a pixel is known from a few replicates alone; and
    // those beyond them, since none of its samples may meet a lamp that covers a hundredth of it.
    const auto counts = [&](std::size_t q) {
        if (least.bounce) return q == static_cast<std::size_t>(*least.bounce);
        return least == LeastError::of_all || (least == LeastError::of_sum) == (q == sum);
    };
    std::vector<std::vector<double>> D(later);
    std::vector<double> noise(pixels, 0.0), of_pixels(pixels);
    for (std::size_t q = 0; q <= sum; ++q) {
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) of_pixels[pixel] = relative(of_direct, of_direct.mean, pixel, q);
        D[q] = smoothed(smoothed(of_pixels, width), width);
        const double all = std::accumulate(D[q].begin(), D[q].end(), 0.0) / static_cast<double>(pixels);
        // A few pixels may have most of it, and walks have no less.
        by_walk[q] = std::max(by_walk[q], price_of_ray_of_walk * of_walk.rays * all);
        for (double& v : D[q]) v = (1.0 - spread_of_parts) * v + spread_of_parts * all;
        if (counts(q) && all > 0.0)
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) noise[pixel] += D[q][pixel] / all;
    }

    CorrectedAllocation best;
    double smallest = std::numeric_limits<double>::infinity(), cost_of_best = 1.0;
    for (double factor = 1.0 / 256.0; factor < 4096.0; factor *= 1.25) {
        std::vector<std::int8_t> doublings(pixels);
        std::vector<double> of_direct_light(later, 0.0);
        double samples = 0.0;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            const double k = std::clamp(std::round(std::log2(factor * std::sqrt(noise[pixel]))), 0.0,
                                        double{most_doublings_of_parts}),
                         d = std::exp2(k);
            doublings[pixel] = static_cast<std::int8_t>(k);
            samples += d / static_cast<double>(pixels);
            for (std::size_t q = 0; q <= sum; ++q) of_direct_light[q] += D[q][pixel] / d / static_cast<double>(pixels);
        }
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const double cost = of_parts[k].rays + of_direct.rays * (samples - 1.0);
            double total = 0.0, largest = 0.0, beside_walk = 1.0, of_sum = 0.0;
            for (std::size_t q = 0; q <= sum; ++q) {
                const double error = cost * (of_direct_light[q] + B[k][q]);
                (q == sum ? of_sum : total) += error;
                if (q < sum && counts(q)) largest = std::max(largest, error);
                // Bounce 0 counts in the sum alone: a walk whose light soon leaves the scene makes little else.
                if (q > 0 && by_walk[q] > 0.0) beside_walk = std::max(beside_walk, error / by_walk[q]);
            }
            const double size = least == LeastError::of_sum   ? of_sum
                                : least == LeastError::of_all ? total * std::pow(beside_walk, weight_of_walk)
                                                              : largest;
            if (!(size > 0.0 && size < smallest)) continue;
            smallest = size;
            cost_of_best = cost;
            best.exponents = doublings;
            best.first.directions = parts[k][0];
            best.first.points = parts[k][1];
        }
    }
    best.first.others_cast_rays = with_rays;
    best.rays = pilots.rays();
    // All of it costs about as much as the same number of equal samples.
    const double shift = std::isfinite(smallest) ? std::round(std::log2(of_parts.front().rays / cost_of_best)) : 0.0;
    best.exponents.resize(pixels, 0);
    for (std::int8_t& k : best.exponents) k = static_cast<std::int8_t>(k + shift);
    best.going_on = static_cast<std::int8_t>(shift);
    return std::make_shared<const CorrectedAllocation>(std::move(best));
}

}  // namespace neumann
