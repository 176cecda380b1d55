#include "operators/pictures/picture_sampler.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <stdexcept>

namespace neumann {

namespace {

constexpr std::size_t non_finite_kept = 16;

// One thread's work space: the walk's samples, and one node of the tree of replicates for each level.
struct Workspace {
    Workspace(std::size_t quantities, std::size_t size, std::size_t levels)
        : rays(size), samples(size * quantities), sum(quantities), carry(quantities * PixelMoments::doubles_per_quantity),
          waiting(levels, carry), tally(quantities) {}
    std::vector<CameraRay> rays;
    Walkers walkers;
    std::vector<Rgb> samples, sum;
    std::vector<double> carry;
    std::vector<std::vector<double>> waiting;
    Tally tally;
};

void keep_first(std::vector<NonFiniteSample>& samples) {
    std::sort(samples.begin(), samples.end());
    if (samples.size() > non_finite_kept) samples.resize(non_finite_kept);
}

// Takes down the samples of one quantity that are not finite, makes them zero, and returns the sum of the others.
Rgb leave_out_non_finite(Workspace& work, std::size_t size, std::size_t q, int px, int py, std::uint64_t replicate) {
    Rgb sum(0.0);
    for (std::size_t i = 0; i < size; ++i) {
        Rgb& x = work.samples[i * work.sum.size() + q];
        if (!is_finite(x)) {
            ++work.tally.non_finite_count;
            work.tally.non_finite.push_back({px, py, static_cast<int>(q), replicate * size + i});
            if (work.tally.non_finite.size() > 4 * non_finite_kept) keep_first(work.tally.non_finite);
            x = Rgb(0.0);
        }
        sum += x;
    }
    return sum;
}

// The mean of one replicate of one pixel, into work.sum; there is a sampler for each of its samples.
template <class Estimator, class Sampler>
void replicate(const Scene& scene, const Estimator& estimate, std::vector<Sampler>& samplers, int px, int py, std::uint64_t replicate,
               Workspace& work) {
    const Film& film = scene.film;
    const std::size_t size = samplers.size(), quantities = work.sum.size();
    for (std::size_t i = 0; i < size; ++i) {
        samplers[i].start(replicate * size + i);
        work.rays[i] = scene.camera.ray(sample(film.filter, samplers[i].next2(), px, py, film.width, film.height));
    }
    std::fill(work.samples.begin(), work.samples.end(), Rgb(0.0));
    TermSamples result{work.samples, work.tally.rays};
    estimate(work.rays, std::span(samplers), work.walkers, result);
    work.tally.given_up += result.given_up;

    for (std::size_t q = 0; q < quantities; ++q) {
        Rgb sum(0.0);
        for (std::size_t i = 0; i < size; ++i) sum += work.samples[i * quantities + q];
        LargestSamples& largest = work.tally.largest[q];
        largest.add_count(size);
        if (!is_finite(sum)) [[unlikely]]
            sum = leave_out_non_finite(work, size, q, px, py, replicate);
        // Samples are not negative, so none exceeds the sum.
        if (max_component(sum) > largest.threshold())
            for (std::size_t i = 0; i < size; ++i) largest.add(max_component(work.samples[i * quantities + q]));
        work.sum[q] = sum * (1.0 / static_cast<double>(size));
    }
}

std::variant<WalkEstimator, PointwiseEstimator> make_estimator(const Scene& scene, const PictureSampler::Settings& settings) {
    if (settings.method == Method::pointwise) return PointwiseEstimator(scene, settings.walk.bounces);
    return WalkEstimator(scene, settings.walk);
}

}  // namespace

void Tally::merge(const Tally& other) {
    for (std::size_t q = 0; q < rays.size(); ++q) {
        rays[q] += other.rays[q];
        largest[q].merge(other.largest[q]);
    }
    given_up += other.given_up;
    non_finite_count += other.non_finite_count;
    non_finite.insert(non_finite.end(), other.non_finite.begin(), other.non_finite.end());
    keep_first(non_finite);
}

PictureSampler::PictureSampler(const Scene& scene, const Settings& settings)
    : scene_(scene), settings_(settings), estimator_(make_estimator(scene, settings)), sobol_(settings.replicate_size) {
    if (!std::has_single_bit(settings.replicate_size)) throw std::logic_error("PictureSampler: replicate_size is not a power of two");
}

std::optional<MomentsNode> PictureSampler::run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                               std::vector<double> memory) const {
    if (!std::has_single_bit(count) || first % count != 0) throw std::logic_error("PictureSampler: not a node of the tree of replicates");
    const std::size_t stride = quantities() * PixelMoments::doubles_per_quantity;
    const auto pixels = static_cast<std::uint32_t>(width()) * static_cast<std::uint32_t>(height());
    const auto levels = static_cast<std::size_t>(std::countr_zero(count)) + 1;
    MomentsNode node{first, count, std::move(memory)};
    node.data.resize(pixels * stride);
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces(
        [&] { return Workspace(quantities(), settings_.replicate_size, levels); });

    std::atomic<std::uint64_t> pixels_done = 0;
    std::atomic<bool> dropped = false;
    const auto run_pixel = [&](const auto& estimator, const auto& sampler, std::uint32_t pixel, Workspace& work) {
        std::vector samplers(settings_.replicate_size, sampler);
        const int px = scene_.film.crop_x + static_cast<int>(pixel) % width(), py = scene_.film.crop_y + static_cast<int>(pixel) / width();
        for (std::uint64_t r = 0; r < count; ++r) {
            replicate(scene_, estimator, samplers, px, py, first + r, work);
            PixelMoments::set(work.carry, work.sum);
            // Nodes of equal size are joined as digits carry in adding 1 to a binary number.
            std::size_t level = 0;
            for (; r >> level & 1; ++level) {
                const auto n = static_cast<double>(std::uint64_t{1} << level);
                PixelMoments::merge(work.waiting[level], n, work.carry, n);
                std::swap(work.waiting[level], work.carry);
            }
            std::swap(work.waiting[level], work.carry);
        }
        std::copy(work.waiting.back().begin(), work.waiting.back().end(), node.data.begin() + static_cast<std::ptrdiff_t>(pixel * stride));
    };
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, pixels, 16), [&](const auto& range) {
        if (dropped) return;
        Workspace& work = workspaces.local();
        for (std::uint32_t pixel = range.begin(); pixel < range.end(); ++pixel) {
            std::visit(
                [&](const auto& estimator) {
                    if (settings_.sampler == SamplerKind::sobol)
                        run_pixel(estimator, SobolSampler(sobol_, settings_.seed, pixel), pixel, work);
                    else
                        run_pixel(estimator, IndependentSampler(settings_.seed, pixel), pixel, work);
                },
                estimator_);
        }
        pixels_done += range.size();
        if (watch && watch(pixels_done)) dropped = true;
    });
    if (dropped) return std::nullopt;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    return node;
}

}  // namespace neumann
