#include "operators/paths/photons/photon_pilot.h"

#include "core/base/error.h"
#include "core/base/median.h"
#include "core/scene/camera_sample.h"
#include "operators/paths/walk/continuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t pilot_stream = 0x70686f746f6e73ull;  // differs from the seed of the pictures
constexpr std::uint32_t fewest_paths = 1u << 16, most_paths = 1u << 20, most_paths_of_pilot = 1u << 18;
// The number of bounces of the pilot's paths, whatever N is: the radii depend only on the scene and the seed.
constexpr int bounces = 16;
// The memory for a photon, with its copies while a pass is made, and the tree.
constexpr double bytes_of_photon = 3.0 * sizeof(Photon);
constexpr std::size_t places = 1024;
// The largest radius, as a part of the median distance of the places that are seen from their middle: only a radius
// that is much smaller than the shapes and shadows has a bias that two radii can show.
constexpr double part_of_what_is_seen = 0.03;
// If that distance is below this part of the scene's radius, it says nothing of the size of shapes, and the scene's
// radius is taken instead.
constexpr double smallest_extent = 1e-4;
constexpr int most_mirrors = 16;

std::uint32_t default_paths(const Film& film) {
    const std::uint64_t wanted = 2 * static_cast<std::uint64_t>(film.crop_width) * static_cast<std::uint64_t>(film.crop_height);
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, fewest_paths, most_paths));
}

// The first points seen in some pixels, possibly by way of delta lobes, at which photons may lie.
std::vector<Vec3> seen_places(const Scene& scene, std::uint64_t seed) {
    std::vector<Vec3> seen;
    const SobolPoints points(places);
    for (std::uint32_t k = 0; k < places; ++k) {
        Sampler sampler(SamplerKind::sobol, points, seed, 0);
        sampler.start(k);
        const Vec2 u = sampler.next2();
        const Film& film = scene.film;
        const CameraSample sample = sample_camera(scene, film.crop_x + static_cast<int>(u.x * film.crop_width),
                                                  film.crop_y + static_cast<int>(u.y * film.crop_height), sampler);
        SurfacePoint x;
        Vec3 w = sample.ray.direction;
        const auto found = [&](std::size_t) -> SurfacePoint& { return x; };
        bool hit = (scene.geometry.first_hits(std::span(&sample.ray, 1), found) & 1u) != 0;
        for (int mirrors = 0; hit && mirrors < most_mirrors; ++mirrors) {
            const SurfaceSide side = scene.materials.side(x, -w);
            if (!side.bsdf) break;
            if (!is_delta_only(*side.bsdf)) {
                seen.push_back(x.position);
                break;
            }
            const BsdfSample next = MaterialContinuation().sample(side, side.p.frame.to_local(-w), sampler);
            if (next.pdf == 0.0) break;
            w = side.p.frame.to_world(next.wi);
            const SurfacePoint from = x;
            hit = (scene.geometry.first_hits(
                       1, [&](std::size_t) { return std::pair<const SurfacePoint&, const Vec3&>(from, w); }, found) &
                   1u) != 0;
        }
    }
    return seen;
}

// The median distance from these places to the k-th photon; ∞ if there are no such photons or places.
double usual_distance(const PhotonMap& map, const std::vector<Vec3>& at) {
    const std::size_t k = std::min(PhotonPilot::photons_in_radius, map.photons().size());
    if (k == 0 || at.empty()) return std::numeric_limits<double>::infinity();
    std::vector<double> all;
    for (const Vec3& x : at) all.push_back(map.distance(x, k));
    return median(all);
}

std::vector<Vec3> some_of(const std::vector<Photon>& photons) {
    std::vector<Vec3> at;
    const std::size_t step = std::max<std::size_t>(photons.size() / places, 1);
    for (std::size_t i = 0; i < photons.size(); i += step) at.emplace_back(photons[i].position);
    return at;
}

}  // namespace

PhotonPilot::PhotonPilot(const Scene& scene, const PhotonChoice& choice, SamplerKind sampler, std::uint64_t seed, double memory,
                         const Watch& watch)
    : settings{.paths = choice.paths.value_or(default_paths(scene.film)), .gather = choice.gather} {
    const std::uint64_t stream = seed ^ pilot_stream;
    PhotonSettings of_pilot = settings;
    of_pilot.paths = std::min(settings.paths, most_paths_of_pilot);
    const WalkSettings walk{.bounces = bounces, .rest_probability = 0.0};
    auto photons = PhotonTracer(scene, walk, of_pilot, sampler, stream).trace(0, watch.stop);
    if (!photons) throw Stopped();
    if (!scene.emitters.empty() && !photons->reach_something)
        throw InputError(fmt::format("photon: none of {} paths from the lights meets a surface; take walk", of_pilot.paths));
    const double more = static_cast<double>(settings.paths) / of_pilot.paths;
    power = photons->power;
    rays = std::accumulate(photons->rays.begin(), photons->rays.end(), std::uint64_t{0});
    caustic_photons = static_cast<std::size_t>(more * static_cast<double>(photons->caustic.size()));
    other_photons = static_cast<std::size_t>(more * static_cast<double>(photons->others.size()));
    const double bytes = bytes_of_photon * static_cast<double>(caustic_photons + other_photons);
    if (bytes > memory)
        throw OptionError("photons",
                          fmt::format("{}: these leave about {:.3g} million photons in a pass, which take {:.1f} GiB, and {:.1f} "
                                      "may be taken; take fewer",
                                      settings.paths, 1e-6 * static_cast<double>(caustic_photons + other_photons), bytes / 0x1p30,
                                      memory / 0x1p30));
    if (choice.radius) {
        settings.radius = settings.caustic_radius = *choice.radius;
        return;
    }
    // The maps of the pictures are denser by this factor.
    part_of_distance_ = 1.0 / std::sqrt(more);
    const PhotonMap others(std::move(photons->others));
    std::vector<Vec3> seen = seen_places(scene, stream);
    if (seen.empty()) seen = some_of(others.photons());
    const double extent = seen.empty() ? 0.0 : median_distance(seen), size = scene.geometry.radius(),
                 largest = part_of_what_is_seen * (extent > smallest_extent * size ? extent : size);
    settings.radius = settings.caustic_radius = std::min(part_of_distance_ * usual_distance(others, seen), largest);
    caustics = std::make_shared<const PhotonMap>(std::move(photons->caustic));
}

}  // namespace neumann
