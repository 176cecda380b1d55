#include "operators/render/from_paths/picture_sampler.h"

#include "core/base/hot.h"
#include "core/base/large_array.h"
#include "operators/render/from_paths/pixel_average.h"
#include "operators/render/from_paths/pixel_samples.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/from_paths/whole_pictures.h"

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

}  // namespace

PictureSampler::PictureSampler(const Scene& scene, const Settings& settings)
    : scene_(scene), settings_(settings), layout_(settings.layout(scene.film)), paths_(settings.method->sampler(scene, settings)) {
    if (!std::has_single_bit(settings.replicate_size))
        throw std::logic_error("PictureSampler: replicate_size is not a power of two");
}

std::optional<MomentsNode> PictureSampler::run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                               std::vector<double> memory) const {
    if (!std::has_single_bit(count) || first % count != 0)
        throw std::logic_error("PictureSampler: not a node of the tree of replicates");
    if (has_whole_pictures())
        return join_pictures(
            first, count, tally, watch, std::move(memory),
            [&](std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& of_node, const Watch& of_picture) {
                return paths_->sample_picture(replicate, picture, ranges, of_node, of_picture);
            });
    MomentsNode node = empty_node(first, count, std::move(memory));
    if (!sample_pixels({first, count, 0, pixels()}, node.data, node.ranges.of, tally, watch)) return std::nullopt;
    return node;
}

std::vector<Share> PictureSampler::shares(std::uint64_t first, std::uint64_t count, std::uint32_t pieces) const {
    std::vector<Share> all;
    if (has_whole_pictures()) {
        for (std::uint64_t r = first; r < first + count; ++r) all.push_back({r, 1, 0, pixels()});
        return all;
    }
    // Each share has whole groups of pixels, so that a group is sampled as it would be without shares.
    const std::uint32_t groups = layout_.groups(), each = std::max(groups / std::max(pieces, 1u), 1u);
    for (std::uint32_t begin = 0; begin < groups; begin += each)
        all.push_back({first, count, layout_.group(begin).begin, layout_.group(std::min(begin + each, groups) - 1).end});
    return all;
}

std::optional<SampledShare> PictureSampler::sample(const Share& share, const Tally& tally, const Watch& watch) const {
    const std::size_t Q = quantities();
    SampledShare sampled{{}, {}, without_smaller_samples(tally)};
    sampled.ranges.of.resize((share.end - share.begin) * Q);
    if (has_whole_pictures()) {
        std::vector<Rgb> picture(pixels() * Q, Rgb(0.0));
        if (!paths_->sample_picture(share.first, picture, sampled.ranges, sampled.tally, watch)) return std::nullopt;
        sampled.data.reserve(picture.size() * 3);
        for (const Rgb& x : picture) sampled.data.insert(sampled.data.end(), {x.r, x.g, x.b});
        return sampled;
    }
    sampled.data.resize((share.end - share.begin) * Q * PixelMoments::doubles_per_quantity);
    if (!sample_pixels(share, sampled.data, sampled.ranges.of, sampled.tally, watch)) return std::nullopt;
    return sampled;
}

std::optional<MomentsNode> PictureSampler::join(std::uint64_t first, std::uint64_t count, std::uint32_t pieces, Tally& tally,
                                                const std::function<std::optional<SampledShare>(const Share&)>& next,
                                                std::vector<double> memory) const {
    const std::size_t Q = quantities();
    if (has_whole_pictures())
        return join_pictures(
            first, count, tally, {}, std::move(memory),
            [&](std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& of_node, const Watch&) {
                const std::optional<SampledShare> sampled = next({replicate, 1, 0, pixels()});
                if (!sampled) return false;
                for (std::size_t i = 0; i < picture.size(); ++i)
                    picture[i] = Rgb(sampled->data[3 * i], sampled->data[3 * i + 1], sampled->data[3 * i + 2]);
                ranges.merge(sampled->ranges);
                of_node.merge(sampled->tally);
                return true;
            });
    MomentsNode node = empty_node(first, count, std::move(memory));
    Tally of_node = without_smaller_samples(tally);
    for (const Share& share : shares(first, count, pieces)) {
        const std::optional<SampledShare> sampled = next(share);
        if (!sampled) return std::nullopt;
        const auto place = static_cast<std::ptrdiff_t>(share.begin * Q);
        std::ranges::copy(sampled->data, node.data.begin() + place * PixelMoments::doubles_per_quantity);
        std::ranges::copy(sampled->ranges.of, node.ranges.of.begin() + place);
        of_node.merge(sampled->tally);
    }
    tally.merge(of_node);
    return node;
}

MomentsNode PictureSampler::empty_node(std::uint64_t first, std::uint64_t count, std::vector<double> memory) const {
    MomentsNode node{first, count, std::move(memory)};
    resize_large(node.data, pixels() * quantities() * PixelMoments::doubles_per_quantity);
    resize_large(node.ranges.of, pixels() * quantities());
    return node;
}

template <class Sample>
std::optional<MomentsNode> PictureSampler::join_pictures(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                                         std::vector<double> memory, const Sample& sample) const {
    SampleRanges ranges;
    ranges.of.resize(pixels() * quantities());
    Tally of_node = without_smaller_samples(tally);
    auto node = run_whole_pictures(first, count, pixels(), quantities(), watch, std::move(memory),
                                   [&](std::uint64_t replicate, std::vector<Rgb>& picture, const Watch& of_picture) {
                                       return sample(replicate, picture, ranges, of_node, of_picture);
                                   });
    if (!node) return std::nullopt;
    tally.merge(of_node);
    node->ranges = std::move(ranges);
    return node;
}

bool PictureSampler::sample_pixels(const Share& share, std::span<double> data, std::span<SampleRange> ranges, Tally& tally,
                                   const Watch& watch) const {
    const TermEstimator& estimate = *paths_->of_pixels();
    const std::uint64_t first = share.first, count = share.count;
    const std::size_t stride = quantities() * PixelMoments::doubles_per_quantity;
    const auto levels = static_cast<std::size_t>(std::countr_zero(count)) + 1;
    oneapi::tbb::enumerable_thread_specific<PixelWork> workspaces([&] {
        PixelWork work(paths_at_once, quantities(), levels);
        work.tally = without_smaller_samples(tally);
        return work;
    });

    std::atomic<std::uint64_t> pixels_done = 0;
    std::atomic<bool> dropped = false;
    // Samples a group of consecutive pixels, starting with `begin`.
    const auto run_pixels = [&](const PixelGroup& group, PixelWork& work) {
        const auto [begin, end, size] = group;
        PixelSamples of_group;
        of_group.begin(scene_.film, settings_, layout_, group);
        const std::vector<Pixel>& some = of_group.pixels;
        const std::size_t place = begin - share.begin;
        for (std::uint64_t r = 0; r < count; ++r) {
            work.tally.given_up += trace(scene_, estimate, std::span(of_group.samplers), std::span<const Pixel>(some), first + r,
                                         work.group, std::span(work.tally.rays));
            for (std::size_t i = 0; i < some.size(); ++i) {
                average(std::span(work.group.samples).subspan(i * size * quantities(), size * quantities()), size,
                        begin + static_cast<std::uint32_t>(i), first + r, settings_.colors, work.average,
                        ranges.subspan((place + i) * quantities(), quantities()), work.tally);
                append(r, work.waiting[i], work);
            }
        }
        for (std::size_t i = 0; i < some.size(); ++i)
            std::ranges::copy(work.waiting[i].back(), data.begin() + static_cast<std::ptrdiff_t>((place + i) * stride));
    };
    // The groups of pixels do not depend on how the work is divided among threads.
    const std::uint32_t all = share.end - share.begin, first_group = layout_.group_of(share.begin),
                        end_group = layout_.group_of(share.end - 1) + 1;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(first_group, end_group, 4), [&](const auto& range) {
        if (dropped) return;
        PixelWork& work = workspaces.local();
        std::uint32_t done = 0;
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
            const PixelGroup some = layout_.group(group);
            run_pixels(some, work);
            done += some.end - some.begin;
        }
        pixels_done += done;
        watch.progress({.fraction = static_cast<double>(pixels_done) / all});
        if (watch.stop()) dropped = true;
    });
    if (dropped) return false;
    for (const PixelWork& work : workspaces) tally.merge(work.tally);
    return true;
}

}  // namespace neumann
