#include "operators/render/from_paths/splat_sampler.h"

#include "operators/in_order.h"
#include "operators/render/from_paths/film_shares.h"
#include "operators/render/from_paths/splat_group.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <algorithm>

namespace neumann {

namespace {

constexpr std::uint32_t groups_at_once = 8;

}  // namespace

std::shared_ptr<const PathSampler> LightPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const SplatSampler>(scene, settings, std::nullopt);
}

Paths LightPaths::paths(const Scene& scene) const {
    return has_specular(scene.materials) || scene.emitters.has_environment() ? Paths::seen_directly : Paths::all;
}

void LightPaths::warn(const Scene& scene, Warnings& warnings) const {
    PathMethod::warn(scene, warnings);
    if (paths(scene) == Paths::seen_directly)
        warnings.add(
            "light makes no path whose last reflection before the camera is in a mirror, of glass or of anything else "
            "that "
            "sends light in a single direction, and does not see what surrounds the scene: these are missing");
}

std::shared_ptr<const PathSampler> BidirectionalPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const SplatSampler>(scene, settings, quantities_);
}

const char* BidirectionalPaths::unfound_in_mirrors() const { return unfound_from_both_ends; }

// The contributions of one piece of work to pixels anywhere on the film, in a fixed order.
struct SplatSampler::Chunk {
    std::vector<PixelShare> shares;
};

SplatSampler::SplatSampler(const Scene& scene, const SamplingSettings& settings,
                           std::optional<BidirectionalPaths::Quantities> joined)
    : PathSampler(scene, settings),
      joined_(joined),
      pixels_(static_cast<std::uint32_t>(scene.film.crop_width) * static_cast<std::uint32_t>(scene.film.crop_height)),
      emission_(scene.geometry, scene.emitters),
      bidirectional_(scene, settings.walk, pixels_),
      light_points_(light_net) {}

void SplatSampler::sample_paths(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk,
                                Workspace& work) const {
    const std::size_t Q = settings_.quantities();
    const auto name = [&](std::uint32_t i) { return layout_.name(replicate, first + i); };
    trace_group(
        replicate, first, samples,
        [&](std::uint32_t i, std::size_t q, const Rgb& value) { work.group.samples[i * Q + q] += value; },
        [&](std::uint32_t i, const Vec2& position, std::size_t q, const Rgb& value) {
            spread(scene_->film, position, q, value / static_cast<double>(pixels_), name(i), chunk.shares, work.tally);
        },
        work);
}

void SplatSampler::sample_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk,
                                std::span<Rgb> own, SampleRanges& ranges, Workspace& work) const {
    const std::size_t Q = settings_.quantities();
    sample_paths(replicate, first, samples, chunk, work);
    if (!joined_) return;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const SampleName name = layout_.name(replicate, first + i);
        const SamplePlace place{name.pixel, name};
        for (std::size_t q = 0; q < Q; ++q) {
            Rgb& x = work.group.samples[i * Q + q];
            if (!is_finite(x)) [[unlikely]] {
                work.tally.keep({static_cast<int>(q), place});
                x = Rgb(0.0);
            }
            work.tally.largest[q].add(max_component(glm::abs(x)), place);
            const Rgb weighted = x * work.group.weights[i];
            own[place.pixel * Q + q] += weighted;
            ranges.of[place.pixel * Q + q].add(weighted);
        }
    }
}

std::optional<std::uint64_t> SplatSampler::own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const {
    const bool done = for_groups(layout_, watch, [&](const PixelGroup& pixels) {
        Workspace work(settings_.quantities());
        Chunk chunk;
        sample_paths(replicate, layout_.first_path(pixels.begin), pixels.paths(), chunk, work);
        std::vector<Rgb>& samples = work.group.samples;
        for (std::size_t k = 0; k < samples.size(); ++k) samples[k] *= work.group.weights[k / settings_.quantities()];
        each(pixels, samples, work.tally.rays);
    });
    return done ? std::optional<std::uint64_t>(0) : std::nullopt;
}

bool SplatSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                  const Watch& watch) const {
    const std::size_t Q = settings_.quantities();
    const std::uint32_t samples = layout_.paths(), groups = layout_.groups();
    std::vector<Rgb> splatted(picture.size(), Rgb(0.0));
    SampleRanges of_shares;
    of_shares.of.resize(picture.size());
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    const std::size_t chunks = (groups + groups_at_once - 1) / groups_at_once;
    const bool done = add_in_order<Chunk>(
        chunks,
        [&](std::size_t k, Chunk& chunk) {
            Workspace& work = workspaces.local();
            chunk.shares.clear();
            const auto begin = static_cast<std::uint32_t>(k) * groups_at_once;
            for (std::uint32_t g = begin; g < std::min(begin + groups_at_once, groups); ++g) {
                const PixelGroup group = layout_.group(g);
                sample_group(replicate, layout_.first_path(group.begin), group.paths(), chunk, picture, ranges, work);
            }
        },
        [&](std::size_t k, const Chunk& chunk) {
            for (const PixelShare& s : chunk.shares) {
                splatted[s.pixel * Q + s.quantity] += s.value;
                of_shares.of[s.pixel * Q + s.quantity].add(s.value);
            }
            watch.progress({.fraction = static_cast<double>(k + 1) / static_cast<double>(chunks)});
            return !watch.stop();
        });
    if (!done) return false;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    for (LargestSamples& largest : tally.largest) largest.add_count(samples);
    // Most paths contribute nothing to a given pixel, so 0 is among the samples.
    for (SampleRange& range : of_shares.of)
        if (range.largest[0] >= range.smallest[0] || !joined_) range.add(Rgb(0.0));
    ranges.merge(of_shares);
    const double of_splats = static_cast<double>(pixels_) / samples;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const double own = 1.0 / std::max(layout_.size(static_cast<std::uint32_t>(i / Q)), 1u);
        picture[i] = own == of_splats ? (picture[i] + splatted[i]) * own : picture[i] * own + splatted[i] * of_splats;
        if (settings_.colors) picture[i] = *settings_.colors * picture[i];
    }
    return true;
}

}  // namespace neumann
