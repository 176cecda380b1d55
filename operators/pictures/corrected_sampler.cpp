#include "operators/pictures/corrected_sampler.h"

#include "operators/pictures/corrected_group.h"
#include "operators/pictures/pixel_groups.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace neumann {

namespace {

constexpr FirstVertex at_point{.lights = 32, .directions = 64, .points = 16, .clamp = 10.0};
// Rays for the points of a replicate, as a part of those for its pixels, roughly.
constexpr double share_of_points = 0.1;
constexpr double fewest_points = 256.0, most_points = 4096.0;

std::uint32_t choose_points(double pixels, const SamplingSettings& settings) {
    const auto rays = [](const FirstVertex& v) { return static_cast<double>(v.lights + v.directions + v.points); };
    const double of_pixel = settings.replicate_size * (1.0 + rays(at_pixel)), of_point = rays(at_point),
                 sets = std::clamp(settings.walk.bounces, 1, 8);
    return std::bit_floor(static_cast<std::uint32_t>(
        std::clamp(share_of_points * pixels * of_pixel / (of_point * sets), fewest_points, most_points)));
}

}  // namespace

CorrectedSampler::CorrectedSampler(const Scene& scene, const SamplingSettings& settings)
    : scene_(&scene),
      settings_(settings),
      pixels_(static_cast<std::uint32_t>(scene.film.crop_width) * static_cast<std::uint32_t>(scene.film.crop_height)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)),
      camera_net_(settings.replicate_size),
      direction_net_(settings.replicate_size * at_pixel.directions) {
    if (!settings.approximation) throw std::logic_error("PictureSampler: corrected fields are missing");
    points_ = std::make_shared<const PointMaker>(scene, *direct_, settings_.walk, *settings_.approximation, settings_.sampler,
                                                 settings_.seed, choose_points(pixels_, settings_), at_point);
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
    return sample_groups<Workspace>(settings_, pixels_, replicate, picture, ranges, tally, watch,
                                    [&](std::uint32_t first, std::uint32_t samples, Workspace& work) {
                                        trace_group(replicate, first, samples, points ? &*points : nullptr, work);
                                    });
}

}  // namespace neumann
