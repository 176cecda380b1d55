#include "operators/render/from_paths/corrected_sampler.h"

#include "operators/render/from_paths/corrected_group.h"
#include "operators/render/from_paths/film_shares.h"
#include "operators/render/from_paths/pixel_groups.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace neumann {

namespace {

constexpr FirstVertex at_point{.lights = 32, .directions = 64, .points = 16, .clamp = 10.0};
constexpr double fewest_points = 256.0, most_points = 4096.0;

std::uint32_t choose_points(double pixels, const SamplingSettings& settings) {
    const auto rays = [](const FirstVertex& v) { return static_cast<double>(v.lights + v.directions + v.points); };
    const double of_pixel = settings.replicate_size * (1.0 + rays(CorrectedAllocation().first)), of_point = rays(at_point),
                 sets = std::clamp(settings.walk.bounces, 1, 8);
    return std::bit_floor(static_cast<std::uint32_t>(
        std::clamp(CorrectedSampler::share_of_points * pixels * of_pixel / (of_point * sets), fewest_points, most_points)));
}

}  // namespace

std::shared_ptr<const PathSampler> CorrectedPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const CorrectedSampler>(scene, settings, approximation_, caustics_);
}

CorrectedSampler::CorrectedSampler(const Scene& scene, const SamplingSettings& settings,
                                   std::shared_ptr<const Approximation> approximation, std::shared_ptr<const CausticAim> caustics)
    : PathSampler(scene, settings),
      approximation_(std::move(approximation)),
      aim_(std::move(caustics)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)) {
    points_ = std::make_shared<const PointMaker>(
        scene, *direct_, settings_.walk, *approximation_, settings_.sampler, settings_.seed,
        choose_points(settings_.pixels_of_shared > 0 ? settings_.pixels_of_shared : layout_.pixels(), settings_), at_point);
    if (const auto* parts = dynamic_cast<const CorrectedAllocation*>(settings.allocation.get())) {
        first_ = parts->first;
        going_on_ = parts->going_on;
    }
    if (aim_ && aim_->pays() && settings.walk.bounces >= 2)
        caustics_.emplace(scene, settings.walk.bounces, approximation_->fields(),
                          points_->sets() > 0 ? first_.clamp / approximation_->area() : 0.0);
    std::uint32_t largest = 1;
    for (std::uint32_t pixel = 0; pixel < layout_.pixels(); ++pixel)
        largest = std::max(largest, size_of_going_on(layout_.size(pixel)));
    for (std::uint32_t size = 1; size <= largest; size *= 2) direction_nets_.emplace_back(size * first_.directions);
}

std::optional<CorrectedSampler::Shared> CorrectedSampler::shared(std::uint64_t replicate,
                                                                 const std::function<void(const Caustics::Seen&)>& seen,
                                                                 std::vector<std::uint64_t>& rays, std::uint64_t& given_up,
                                                                 const Watch& watch) const {
    Shared result;
    if (caustics_) {
        const double samples = static_cast<double>(settings_.replicate_size) * layout_.pixels();
        auto made = caustics_->make(*aim_, replicate, samples, settings_.sampler, settings_.seed, seen, watch);
        if (!made) return std::nullopt;
        result.caustics = std::move(made->points);
        for (std::size_t q = 0; q < made->rays.size(); ++q) rays[q] += made->rays[q];
    }
    if (points_->sets() > 0) {
        result.errors = points_->make(replicate, caustics_ ? &*caustics_ : nullptr, result.points().caustics,
                                      rays[std::min<std::size_t>(2, rays.size() - 1)], given_up, watch);
        if (!result.errors) return std::nullopt;
    }
    return result;
}

bool CorrectedSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                      const Watch& watch) const {
    const std::size_t Q = settings_.quantities();
    std::vector<Rgb> splatted(caustics_ ? picture.size() : 0, Rgb(0.0));
    const auto add = [&](const Caustics::Seen& seen) {
        if (!is_finite(seen.value)) {
            const std::uint32_t pixel = pixel_at(scene_->film, seen.position);
            tally.keep({static_cast<int>(seen.bounce), {pixel, {pixel, replicate * settings_.replicate_size}}});
            return;
        }
        for_pixels_reached(scene_->film, seen.position, [&](std::uint32_t pixel, double weight) {
            splatted[pixel * Q + seen.bounce] += seen.value * weight;
            ranges.of[pixel * Q + seen.bounce].add(seen.value * weight * static_cast<double>(settings_.replicate_size));
        });
    };
    std::vector<std::uint64_t> rays(Q);
    const std::optional<Shared> made = shared(replicate, add, rays, tally.given_up, watch);
    if (!made) return false;
    for (std::size_t q = 0; q < Q; ++q) {
        tally.rays[q] += rays[q];
        tally.shared_rays += rays[q];
    }
    if (!sample_groups<Workspace>(
            settings_, layout_, replicate, picture, ranges, tally, watch,
            [&](const PixelGroup& pixels, Workspace& work) { trace_group(replicate, pixels, made->points(), work); }))
        return false;
    for (std::size_t i = 0; i < splatted.size(); ++i)
        picture[i] += settings_.colors ? *settings_.colors * splatted[i] : splatted[i];
    return true;
}

std::optional<std::uint64_t> CorrectedSampler::own_samples(std::uint64_t replicate, const OwnSamples& each,
                                                           const Watch& watch) const {
    std::vector<std::uint64_t> rays(settings_.quantities());
    std::uint64_t given_up = 0;
    const std::optional<Shared> made = shared(replicate, nullptr, rays, given_up, watch);
    if (!made || !own_samples(replicate, made->points(), each, watch)) return std::nullopt;
    return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
}

bool CorrectedSampler::own_samples(std::uint64_t replicate, const JoinedPoints& points, const OwnSamples& each,
                                   const Watch& watch) const {
    return for_groups(layout_, watch, [&](const PixelGroup& pixels) {
        Workspace work(settings_.quantities());
        trace_group(replicate, pixels, points, work);
        each(pixels, work.group.samples, work.tally.rays);
    });
}

}  // namespace neumann
