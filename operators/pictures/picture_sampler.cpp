#include "operators/pictures/picture_sampler.h"

#include "core/base/hot.h"
#include "core/base/large_array.h"
#include "operators/pictures/path_group.h"
#include "operators/pictures/pixel_average.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <bit>
#include <span>
#include <stdexcept>

namespace neumann {

namespace {

// One thread's work space for some pixels at once: the walks' samples, and one node of the tree of replicates for each level and
// pixel.
struct PixelWork {
    PixelWork(std::size_t pixels, std::size_t quantities, std::size_t levels)
        : average(quantities),
          carry(quantities * PixelMoments::doubles_per_quantity),
          waiting(pixels, std::vector(levels, carry)),
          tally(quantities) {}
    PathGroup group;
    PixelAverage average;
    std::vector<double> carry;
    std::vector<std::vector<std::vector<double>>> waiting;
    Tally tally;
};

// Appends the means as the r-th replicate: nodes of equal size are merged, like carries when 1 is added to a binary number.
void append(std::uint64_t r, std::vector<std::vector<double>>& waiting, PixelWork& work) {
    PixelMoments::set(work.carry, work.average.mean);
    std::size_t level = 0;
    for (; r >> level & 1; ++level) {
        const auto n = static_cast<double>(std::uint64_t{1} << level);
        PixelMoments::merge(waiting[level], n, work.carry, n);
        std::swap(waiting[level], work.carry);
    }
    std::swap(waiting[level], work.carry);
}

std::variant<TermEstimator, SplatSampler, CorrectedSampler> make_sampler(const Scene& scene, const SamplingSettings& settings) {
    if (splats(settings.generator)) return SplatSampler(scene, settings);
    if (settings.generator == PathGenerator::corrected) return CorrectedSampler(scene, settings);
    return make_estimator(scene, settings);
}

}  // namespace

PictureSampler::PictureSampler(const Scene& scene, const Settings& settings)
    : scene_(scene), settings_(settings), sampler_(make_sampler(scene, settings)), sobol_(settings.replicate_size) {
    if (!std::has_single_bit(settings.replicate_size))
        throw std::logic_error("PictureSampler: replicate_size is not a power of two");
}

std::optional<MomentsNode> PictureSampler::run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                               std::vector<double> memory) const {
    if (!std::has_single_bit(count) || first % count != 0)
        throw std::logic_error("PictureSampler: not a node of the tree of replicates");
    if (const auto* whole_pictures = std::get_if<SplatSampler>(&sampler_))
        return whole_pictures->run(first, count, tally, watch, std::move(memory));
    if (const auto* corrected = std::get_if<CorrectedSampler>(&sampler_))
        return corrected->run(first, count, tally, watch, std::move(memory));
    const TermEstimator& estimator = std::get<TermEstimator>(sampler_);
    const std::size_t stride = quantities() * PixelMoments::doubles_per_quantity;
    const auto pixels = static_cast<std::uint32_t>(width()) * static_cast<std::uint32_t>(height());
    const auto levels = static_cast<std::size_t>(std::countr_zero(count)) + 1;
    MomentsNode node{first, count, std::move(memory)};
    resize_large(node.data, pixels * stride);
    resize_large(node.ranges.of, pixels * quantities());
    const std::uint32_t size = settings_.replicate_size, pixels_at_once = std::max(paths_at_once / size, 1u);
    oneapi::tbb::enumerable_thread_specific<PixelWork> workspaces([&] {
        PixelWork work(pixels_at_once, quantities(), levels);
        for (std::size_t q = 0; q < quantities(); ++q) work.tally.largest[q].outdo(tally.largest[q]);
        return work;
    });

    std::atomic<std::uint64_t> pixels_done = 0;
    std::atomic<bool> dropped = false;
    // Samples a group of consecutive pixels, starting with `begin`.
    const auto run_pixels = [&](const auto& estimate, std::uint32_t begin, std::uint32_t end, PixelWork& work) {
        std::vector<Pixel> some;
        std::vector<Sampler> samplers;
        for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
            some.push_back(pixel_of(scene_.film, pixel));
            samplers.resize(samplers.size() + size, Sampler(settings_.sampler, sobol_, settings_.seed, pixel));
        }
        for (std::uint64_t r = 0; r < count; ++r) {
            work.tally.given_up += trace(scene_, estimate, std::span(samplers), std::span<const Pixel>(some), first + r, work.group,
                                         std::span(work.tally.rays));
            for (std::size_t i = 0; i < some.size(); ++i) {
                average(std::span(work.group.samples).subspan(i * size * quantities(), size * quantities()), size,
                        begin + static_cast<std::uint32_t>(i), first + r, settings_.colors, work.average,
                        std::span(node.ranges.of).subspan((begin + i) * quantities(), quantities()), work.tally);
                append(r, work.waiting[i], work);
            }
        }
        for (std::size_t i = 0; i < some.size(); ++i)
            std::copy(work.waiting[i].back().begin(), work.waiting[i].back().end(),
                      node.data.begin() + static_cast<std::ptrdiff_t>((begin + i) * stride));
    };
    // The groups of pixels do not depend on how the work is divided among threads.
    const std::uint32_t groups = (pixels + pixels_at_once - 1) / pixels_at_once;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        if (dropped) return;
        PixelWork& work = workspaces.local();
        std::uint32_t done = 0;
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
            const std::uint32_t begin = group * pixels_at_once, end = std::min(begin + pixels_at_once, pixels);
            std::visit([&](const auto& estimate) { run_pixels(estimate, begin, end, work); }, estimator);
            done += end - begin;
        }
        pixels_done += done;
        watch.progress({.fraction = static_cast<double>(pixels_done) / pixels});
        if (watch.stop()) dropped = true;
    });
    if (dropped) return std::nullopt;
    for (const PixelWork& work : workspaces) tally.merge(work.tally);
    return node;
}

}  // namespace neumann
