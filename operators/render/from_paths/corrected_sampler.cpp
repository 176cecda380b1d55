#include "operators/render/from_paths/corrected_sampler.h"

#include "operators/render/from_paths/corrected_group.h"
#include "operators/render/from_paths/pixel_groups.h"

#include <algorithm>
#include <bit>

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
    return std::make_shared<const CorrectedSampler>(scene, settings, approximation_);
}

CorrectedSampler::CorrectedSampler(const Scene& scene, const SamplingSettings& settings,
                                   std::shared_ptr<const Approximation> approximation)
    : PathSampler(scene, settings),
      approximation_(std::move(approximation)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)) {
    points_ = std::make_shared<const PointMaker>(
        scene, *direct_, settings_.walk, *approximation_, settings_.sampler, settings_.seed,
        choose_points(settings_.pixels_of_shared > 0 ? settings_.pixels_of_shared : layout_.pixels(), settings_), at_point);
    if (const auto* parts = dynamic_cast<const CorrectedAllocation*>(settings.allocation.get())) {
        first_ = parts->first;
        going_on_ = parts->going_on;
    }
    std::uint32_t largest = 1;
    for (std::uint32_t pixel = 0; pixel < layout_.pixels(); ++pixel)
        largest = std::max(largest, size_of_going_on(layout_.size(pixel)));
    for (std::uint32_t size = 1; size <= largest; size *= 2) direction_nets_.emplace_back(size * first_.directions);
}

bool CorrectedSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                      const Watch& watch) const {
    const std::size_t Q = settings_.quantities();
    std::uint64_t rays = 0;
    std::optional<SharedPoints> points;
    if (points_->sets() > 0) {
        points = points_->make(replicate, rays, tally.given_up, watch);
        if (!points) return false;
    }
    tally.rays[std::min<std::size_t>(2, Q - 1)] += rays;
    tally.shared_rays += rays;
    return sample_groups<Workspace>(
        settings_, layout_, replicate, picture, ranges, tally, watch,
        [&](const PixelGroup& pixels, Workspace& work) { trace_group(replicate, pixels, points ? &*points : nullptr, work); });
}

std::optional<std::uint64_t> CorrectedSampler::own_samples(std::uint64_t replicate, const OwnSamples& each,
                                                           const Watch& watch) const {
    std::uint64_t rays = 0;
    const std::optional<SharedPoints> points = points_of(replicate, rays, watch);
    if (!points && points_->sets() > 0) return std::nullopt;
    return own_samples(replicate, points ? &*points : nullptr, each, watch) ? std::optional(rays) : std::nullopt;
}

std::optional<SharedPoints> CorrectedSampler::points_of(std::uint64_t replicate, std::uint64_t& rays, const Watch& watch) const {
    std::uint64_t given_up = 0;
    return points_->make(replicate, rays, given_up, watch);
}

bool CorrectedSampler::own_samples(std::uint64_t replicate, const SharedPoints* points, const OwnSamples& each,
                                   const Watch& watch) const {
    return for_groups(layout_, watch, [&](const PixelGroup& pixels) {
        Workspace work(settings_.quantities());
        trace_group(replicate, pixels, points, work);
        each(pixels, work.group.samples, work.tally.rays);
    });
}

}  // namespace neumann
