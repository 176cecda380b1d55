#include "operators/pictures/checkup.h"

#include "core/geometry/rounding.h"
#include "operators/pictures/path_group.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace neumann {

namespace {

constexpr std::uint64_t checkup_stream = 0x636865636b7570ull;  // another seed than the pictures'
constexpr std::uint64_t most_groups = 256, fewest_groups = 16, vertices = 1u << 20;
constexpr int most_bounces = 64;
constexpr std::size_t self_hits_kept = 4;

// The energy balance covers the bounces whose reflection is always sampled.
int bounces_of_camera_paths(const SamplingSettings& settings) {
    const WalkSettings& walk = settings.walk;
    const bool found_by_points = walk.direct.direct != DirectLight::bsdf && walk.direct.direct != DirectLight::mis;
    const bool ends_early = settings.generator != PathGenerator::bidirectional && found_by_points && walk.rest_probability == 0.0;
    return std::min(walk.bounces - (ends_early ? 1 : 0), most_bounces);
}
int bounces_of_light_paths(const SamplingSettings& settings) {
    const bool ends_early = settings.generator == PathGenerator::bidirectional || settings.walk.rest_probability == 0.0;
    return std::min(settings.walk.bounces - (ends_early ? 1 : 0), most_bounces);
}

// Inspects one group of paths.
struct GroupCheckup : PathObserver {
    GroupCheckup(const SampleLayout& layout, std::uint64_t replicate, const PixelGroup& group, bool meets)
        : layout(layout),
          replicate(replicate),
          first(layout.first_path(group.begin)),
          paths(group.paths()),
          rays_meet_surfaces(meets) {}

    const SampleLayout& layout;
    std::uint64_t replicate;
    std::uint32_t first, paths;
    bool rays_meet_surfaces;  // false if rays end at sampled points, which may lie in the plane of their start
    std::optional<BalanceSheet> camera, light;
    std::uint64_t rays = 0;
    std::vector<SelfHit> self_hits;

    void step(std::uint32_t path, const PathStep& step) override {
        for (auto* sheet : {&camera, &light})
            if (*sheet) (*sheet)->add(path, step);
        const bool leaves_surface = step.kind == PathStep::Kind::goes_on || (step.kind == PathStep::Kind::first && step.from_light);
        if (!leaves_surface || !rays_meet_surfaces) return;
        ++rays;
        if (step.found && is_self_hit(step.from, step.to))
            self_hits.push_back({step.bounce, layout.name(replicate, first + path), step.to.shape,
                                 glm::length(step.to.position - step.from.position)});
    }
};

}  // namespace

bool is_self_hit(const SurfacePoint& from, const SurfacePoint& to) {
    const bool parallel = 1.0 - std::abs(glm::dot(from.normal, to.normal)) <= 1e-12;
    // Hits close by were computed in double.
    const double rounding = from.close ? double_rounding(from.position, largest_component(to.position)) : from.error + to.error;
    return parallel && std::abs(glm::dot(from.normal, to.position - from.position)) <= rounding;
}

double Checkup::self_hits_at_most() const {
    if (rays == 0) return 1.0;
    const double count = 0.5 * boost::math::quantile(boost::math::chi_squared(2.0 * static_cast<double>(self_hits) + 2.0), 0.95);
    return std::min(count / static_cast<double>(rays), 1.0);
}

std::optional<Checkup> check_up(const Scene& scene, const PictureSampler& sampler, std::uint64_t samples) {
    const SamplingSettings& settings = sampler.settings();
    if (settings.generator == PathGenerator::pointwise || settings.generator == PathGenerator::corrected ||
        has_two_radii(settings.generator) || settings.generator == PathGenerator::metropolis || settings.generator == PathGenerator::mixed)
        return std::nullopt;
    const std::uint32_t size = settings.replicate_size;
    const SampleLayout& layout = sampler.layout();
    const std::uint64_t groups = layout.groups(), all = groups * (samples / size);
    const auto length = static_cast<std::uint64_t>(settings.walk.bounces) + 1;
    const std::uint64_t count = std::min(all, std::clamp(vertices / (paths_at_once * length), fewest_groups, most_groups));

    // With `surface` and `classic`, the paths' weights are not the energy that arrives.
    const bool by_material = settings.generator != PathGenerator::surface && settings.generator != PathGenerator::classic;
    const int camera_bounces = settings.generator == PathGenerator::light || !by_material ? 0 : bounces_of_camera_paths(settings),
              light_bounces = splats(settings.generator) ? bounces_of_light_paths(settings) : 0;
    std::vector<std::optional<GroupCheckup>> found(count);
    oneapi::tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t k) {
        const std::uint64_t group = k * all / count;
        GroupCheckup& look = found[k].emplace(layout, group / groups, layout.group(static_cast<std::uint32_t>(group % groups)),
                                              settings.generator != PathGenerator::surface);
        const auto stream = static_cast<std::uint32_t>(2 * k);
        const std::uint64_t seed = settings.seed ^ checkup_stream;
        if (camera_bounces > 0) look.camera.emplace(scene, false, camera_bounces, settings.walk.split.walks, seed, stream);
        if (light_bounces > 0) look.light.emplace(scene, true, light_bounces, 1, seed, stream + 1);
        (void)sampler.retrace(look.replicate, look.first, look);
        for (auto* sheet : {&look.camera, &look.light})
            if (*sheet) (*sheet)->finish(look.paths);
    });

    Checkup result;
    std::vector<std::vector<EnergyShares>> camera, light;
    for (auto& look : found) {
        result.paths += look->paths;
        result.rays += look->rays;
        result.self_hits += look->self_hits.size();
        result.first_self_hits.insert(result.first_self_hits.end(), look->self_hits.begin(), look->self_hits.end());
        if (look->camera) camera.push_back(look->camera->shares());
        if (look->light) light.push_back(look->light->shares());
    }
    std::sort(result.first_self_hits.begin(), result.first_self_hits.end());
    if (result.first_self_hits.size() > self_hits_kept) result.first_self_hits.resize(self_hits_kept);
    if (!camera.empty()) result.camera = balance(camera);
    if (!light.empty()) result.light = balance(light);
    return result;
}

}  // namespace neumann
