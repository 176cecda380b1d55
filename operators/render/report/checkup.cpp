#include "operators/render/report/checkup.h"

#include "core/geometry/rounding.h"
#include "operators/paths/walk/path_group.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace neumann {

namespace {

constexpr std::uint64_t checkup_stream = 0x636865636b7570ull;  // differs from the seed of the pictures
constexpr std::uint64_t most_groups = 256, fewest_groups = 16, vertices = 1u << 20;
constexpr int most_bounces = 64;
constexpr std::size_t self_hits_kept = 4;

bool joins_subpaths(const PathMethod& method) { return method.starts_at_camera() && method.starts_at_lights(); }

// The energy balance covers the bounces whose reflection is always sampled.
int bounces_of_camera_paths(const SamplingSettings& settings) {
    if (!settings.method->starts_at_camera()) return 0;
    const WalkSettings& walk = settings.walk;
    const bool ends_early = !joins_subpaths(*settings.method) && !settings.weighs_directions() && walk.rest_probability == 0.0;
    return std::min(walk.bounces - (ends_early ? 1 : 0), most_bounces);
}
int bounces_of_light_paths(const SamplingSettings& settings) {
    if (!settings.method->starts_at_lights()) return 0;
    const bool ends_early = joins_subpaths(*settings.method) || settings.walk.rest_probability == 0.0;
    return std::min(settings.walk.bounces - (ends_early ? 1 : 0), most_bounces);
}

// Some paths of a replicate that are traced together.
struct Group {
    std::uint64_t replicate;
    PathsToInspect::Group paths;
};

struct GroupCheckup : PathObserver {
    GroupCheckup(const SampleLayout& layout, const Group& group, bool meets)
        : layout(layout), replicate(group.replicate), paths(group.paths), rays_meet_surfaces(meets) {}

    const SampleLayout& layout;
    std::uint64_t replicate;
    PathsToInspect::Group paths;
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
            self_hits.push_back({step.bounce, layout.name(replicate, paths.first + path), step.to.shape,
                                 glm::length(step.to.position - step.from.position)});
    }
};

}  // namespace

bool is_self_hit(const SurfacePoint& from, const SurfacePoint& to) {
    const bool parallel = 1.0 - std::abs(glm::dot(from.normal, to.normal)) <= 1e-12;
    // Close hits were computed in double.
    const double rounding = from.close ? double_rounding(from.position, largest_component(to.position)) : from.error + to.error;
    return parallel && std::abs(glm::dot(from.normal, to.position - from.position)) <= rounding;
}

double Checkup::self_hits_at_most() const {
    if (rays == 0) return 1.0;
    const double count = 0.5 * boost::math::quantile(boost::math::chi_squared(2.0 * static_cast<double>(self_hits) + 2.0), 0.95);
    return std::min(count / static_cast<double>(rays), 1.0);
}

namespace {

// The findings of some paths; `camera` and `light` hold an observation of each group.
struct Inspection {
    std::uint64_t paths = 0, rays = 0;
    std::vector<SelfHit> self_hits;
    std::vector<std::vector<EnergyShares>> camera, light;

    void add(Inspection other) {
        paths += other.paths;
        rays += other.rays;
        const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
        append(self_hits, other.self_hits);
        append(camera, other.camera);
        append(light, other.light);
    }
};

Inspection inspect(const Scene& scene, const PictureSampler& sampler, std::uint64_t samples) {
    const SamplingSettings& settings = sampler.settings();
    const SampleLayout& layout = sampler.layout();
    const auto paths = sampler.path_sampler().to_inspect();
    const std::uint64_t groups = paths->groups(),
                        all = groups * (paths->are_of_first_replicate() ? 1 : samples / settings.replicate_size);
    const auto length = static_cast<std::uint64_t>(settings.walk.bounces) + 1;
    const std::uint64_t count = std::min(all, std::clamp(vertices / (paths_at_once * length), fewest_groups, most_groups));
    const auto group_of = [&](std::uint64_t k) -> Group {
        const std::uint64_t number = k * all / count;
        return {number / groups, paths->group(static_cast<std::uint32_t>(number % groups))};
    };

    const bool has_balance = settings.method->why_no_balance().empty();
    const int camera_bounces = has_balance ? bounces_of_camera_paths(settings) : 0,
              light_bounces = has_balance ? bounces_of_light_paths(settings) : 0;
    std::vector<std::optional<GroupCheckup>> found(count);
    oneapi::tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t k) {
        GroupCheckup& look = found[k].emplace(layout, group_of(k), settings.method->rays_meet_surfaces());
        const auto stream = static_cast<std::uint32_t>(2 * k);
        const std::uint64_t seed = settings.seed ^ checkup_stream;
        if (camera_bounces > 0) look.camera.emplace(scene, false, camera_bounces, settings.walk.split.walks, seed, stream);
        if (light_bounces > 0) look.light.emplace(scene, true, light_bounces, 1, seed, stream + 1);
        paths->retrace(look.replicate, look.paths, look);
        for (auto* sheet : {&look.camera, &look.light})
            if (*sheet) (*sheet)->finish(look.paths.paths);
    });

    Inspection result;
    for (auto& look : found) {
        Inspection of_group{look->paths.paths, look->rays, std::move(look->self_hits), {}, {}};
        if (look->camera) of_group.camera.push_back(look->camera->shares());
        if (look->light) of_group.light.push_back(look->light->shares());
        result.add(std::move(of_group));
    }
    return result;
}

// The balance of the bounces that all observations have.
std::optional<EnergyBalance> balance_of(std::vector<std::vector<EnergyShares>> observations) {
    if (observations.empty()) return std::nullopt;
    const std::size_t length = std::ranges::min(observations, {}, &std::vector<EnergyShares>::size).size();
    for (auto& of_bounces : observations) of_bounces.resize(length);
    return balance(observations);
}

}  // namespace

std::optional<Checkup> check_up(const Scene& scene, const PictureSampler& sampler, std::uint64_t samples) {
    if (!sampler.settings().method->why_no_checkup().empty()) return std::nullopt;
    Inspection all;
    const std::uint64_t parts = sampler.path_sampler().parts();
    for (std::uint64_t part = 0; part < parts; ++part) {
        Inspection of_part = inspect(scene, sampler.path_sampler().part_of({0, part}).sampler, samples);
        for (SelfHit& hit : of_part.self_hits) hit.name.sample = hit.name.sample * parts + part;
        all.add(std::move(of_part));
    }
    if (parts == 0) all = inspect(scene, sampler, samples);

    Checkup result{all.paths,
                   all.rays,
                   all.self_hits.size(),
                   std::move(all.self_hits),
                   balance_of(std::move(all.camera)),
                   balance_of(std::move(all.light))};
    std::sort(result.first_self_hits.begin(), result.first_self_hits.end());
    if (result.first_self_hits.size() > self_hits_kept) result.first_self_hits.resize(self_hits_kept);
    return result;
}

}  // namespace neumann
