#include "operators/pictures/splat_sampler.h"

#include "operators/pictures/splat_group.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <algorithm>
#include <atomic>

namespace neumann {

namespace {

// Number of groups in one Chunk of work.
constexpr std::uint32_t groups_at_once = 8;

}  // namespace

// The contributions of one piece of work to pixels anywhere on the film, in a fixed order.
struct SplatSampler::Chunk {
    struct Share {
        std::uint32_t pixel, quantity;
        Rgb value;
    };
    std::uint32_t first = 0, end = 0;  // samples of the replicate
    std::vector<Share> shares;
};

SplatSampler::SplatSampler(const Scene& scene, const SamplingSettings& settings)
    : scene_(&scene),
      settings_(settings),
      pixels_(static_cast<std::uint32_t>(scene.film.crop_width) * static_cast<std::uint32_t>(scene.film.crop_height)),
      emission_(scene.geometry, scene.emitters),
      lights_(scene.geometry, scene.emitters),
      bidirectional_(scene, settings.walk, pixels_),
      camera_points_(settings.replicate_size),
      light_points_(light_net) {}

// Adds a contribution to the pixels whose filter covers `position`. `value` is radiance times the number of pixels, for one path
// per pixel.
void SplatSampler::spread(const Vec2& position, std::size_t quantity, const Rgb& value, const SampleName& name, Chunk& chunk,
                          Workspace& work) const {
    const Film& film = scene_->film;
    const Rgb each = value / static_cast<double>(pixels_);
    const SamplePlace place{pixel_at(position), name};
    if (!is_finite(each)) [[unlikely]] {
        work.tally.keep({static_cast<int>(quantity), place});
        return;
    }
    double largest = 0.0;
    for_pixels_reached(film, position, [&](std::uint32_t pixel, double weight) {
        largest = std::max(largest, std::abs(weight));
        chunk.shares.push_back({pixel, static_cast<std::uint32_t>(quantity), each * weight});
    });
    work.tally.largest[quantity].add(max_component(each) * largest, place);
}

std::uint32_t SplatSampler::pixel_at(const Vec2& position) const {
    const Film& film = scene_->film;
    const int x = std::clamp(static_cast<int>(std::floor(position.x)) - film.crop_x, 0, film.crop_width - 1),
              y = std::clamp(static_cast<int>(std::floor(position.y)) - film.crop_y, 0, film.crop_height - 1);
    return static_cast<std::uint32_t>(y * film.crop_width + x);
}

void SplatSampler::sample_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk,
                                std::span<Rgb> own, SampleRanges& ranges, Workspace& work) const {
    const std::size_t Q = settings_.quantities();
    const auto name = [&](std::uint32_t i) { return name_in_group(replicate, first, i, settings_.replicate_size); };
    trace_group(
        replicate, first, samples,
        [&](std::uint32_t i, std::size_t q, const Rgb& value) { work.group.samples[i * Q + q] += value; },
        [&](std::uint32_t i, const Vec2& position, std::size_t q, const Rgb& value) {
            spread(position, q, value, name(i), chunk, work);
        },
        work);
    if (settings_.generator == PathGenerator::light) return;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const SamplePlace place{name(i).pixel, name(i)};
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

bool SplatSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                  const Watch& watch) const {
    const std::size_t Q = settings_.quantities();
    const std::uint32_t samples = pixels_ * settings_.replicate_size, at_once = paths_at_once * groups_at_once;
    std::vector<Rgb> splatted(picture.size(), Rgb(0.0));
    SampleRanges of_shares;
    of_shares.of.resize(picture.size());
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    const auto run_chunk = [&](Chunk& chunk) {
        Workspace& work = workspaces.local();
        chunk.shares.clear();
        for (std::uint32_t first = chunk.first; first < chunk.end; first += paths_at_once) {
            const std::uint32_t n = std::min(paths_at_once, chunk.end - first);
            sample_group(replicate, first, n, chunk, picture, ranges, work);
        }
    };
    // Chunks are computed in any order and added in a fixed one: the same bits on any number of threads.
    const std::size_t in_flight = 4 * static_cast<std::size_t>(oneapi::tbb::info::default_concurrency());
    std::vector<Chunk> chunks(in_flight);
    std::uint32_t next = 0;
    std::size_t begun = 0;
    std::atomic<bool> dropped = false;
    oneapi::tbb::parallel_pipeline(
        in_flight, oneapi::tbb::make_filter<void, Chunk*>(oneapi::tbb::filter_mode::serial_in_order,
                                                          [&](oneapi::tbb::flow_control& control) -> Chunk* {
                                                              if (next >= samples || dropped) {
                                                                  control.stop();
                                                                  return nullptr;
                                                              }
                                                              Chunk& chunk = chunks[begun++ % in_flight];
                                                              chunk.first = next;
                                                              chunk.end = next = std::min(next + at_once, samples);
                                                              return &chunk;
                                                          }) &
                       oneapi::tbb::make_filter<Chunk*, Chunk*>(oneapi::tbb::filter_mode::parallel,
                                                                [&](Chunk* chunk) {
                                                                    run_chunk(*chunk);
                                                                    return chunk;
                                                                }) &
                       oneapi::tbb::make_filter<Chunk*, void>(oneapi::tbb::filter_mode::serial_in_order, [&](const Chunk* chunk) {
                           for (const Chunk::Share& s : chunk->shares) {
                               splatted[s.pixel * Q + s.quantity] += s.value;
                               of_shares.of[s.pixel * Q + s.quantity].add(s.value);
                           }
                           watch.progress({.fraction = static_cast<double>(chunk->end) / samples});
                           if (watch.stop()) dropped = true;
                       }));
    if (dropped) return false;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    for (LargestSamples& largest : tally.largest) largest.add_count(samples);
    // Most paths contribute nothing to a given pixel, so 0 is among the samples.
    for (SampleRange& range : of_shares.of)
        if (range.largest[0] >= range.smallest[0] || settings_.generator == PathGenerator::light) range.add(Rgb(0.0));
    ranges.merge(of_shares);
    const double each = 1.0 / settings_.replicate_size;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        picture[i] = (picture[i] + splatted[i]) * each;
        if (settings_.colors) picture[i] = *settings_.colors * picture[i];
    }
    return true;
}

}  // namespace neumann
