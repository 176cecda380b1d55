#include "operators/paths/walk/place_pilot.h"

#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "operators/paths/walk/path_group.h"
#include "operators/paths/walk/tree_walk.h"
#include "operators/paths/walk/vertices_of_walks.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace neumann {

namespace {

constexpr int cubes_along = 16;  // cubes along the scene
// The samples of a pixel in each round. What the last round has learned counts: its walks branch almost as those of the render. A
// round more counts the rays.
constexpr std::array<std::uint32_t, 5> rounds{16, 16, 32, 64, 128};
constexpr double darkness = 0.1;               // of the picture's mean, is added to the light of a pixel
constexpr std::uint32_t fewest_branches = 32;  // from a cube, of which moments are believed

// A branch, and what it and those that it became have brought.
struct Branch {
    PlaceRatios::Key key;
    double weight2;  // β², which with `found` gives moments of a branch of weight 1
    Rgb found{0.0};
    double rays = 0.0;
};

// Keeps the branches of the walks of one pixel.
class Branches : public NoObserver {
public:
    struct Log {
        std::vector<Branch> all;
        std::vector<std::uint32_t> parent;   // of each; of the first ones, `none`
        std::vector<std::uint32_t> twins;    // second branches from a vertex; the first is the one before
        std::vector<std::uint32_t> current;  // of each walker
    };
    static constexpr std::uint32_t none = 0xffffffffu;

    Branches(const PlaceRatios& ratios, Log& log) : ratios_(ratios), log_(log) {}

    void branches(int bounce, std::span<const Walker> walkers, std::span<const std::uint32_t> of) const {
        std::vector<std::uint32_t> next(walkers.size());
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            next[i] = static_cast<std::uint32_t>(log_.all.size());
            if (i > 0 && of[i] == of[i - 1] && (i == 1 || of[i] != of[i - 2])) log_.twins.push_back(next[i]);
            log_.all.push_back({ratios_.key(bounce, walkers[i]), glm::dot(walkers[i].beta, walkers[i].beta)});
            log_.parent.push_back(log_.current.empty() ? none : log_.current[of[i]]);
        }
        log_.current = std::move(next);
    }
    void casts(std::uint32_t walker, bool, int, const PathEnd&) const { count_ray(walker); }
    void casts_shadow_ray(std::uint32_t walker, bool, int, const SurfacePoint&, const Vec3&, const SurfacePoint&, bool) const {
        count_ray(walker);
    }
    void finds(std::uint32_t walker, std::size_t, const Rgb& light) const {
        if (!log_.current.empty()) log_.all[log_.current[walker]].found += light;
    }

private:
    // Rays of the camera belong to no branch.
    void count_ray(std::uint32_t walker) const {
        if (!log_.current.empty()) log_.all[log_.current[walker]].rays += 1.0;
    }

    const PlaceRatios& ratios_;
    Log& log_;
};

// What two branches from one vertex have brought: X·X', whose mean is that of E[X | vertex]².
struct Twins {
    PlaceRatios::Key key;
    double weight2, product;
};

struct OfPixel {
    std::vector<Branch> branches;
    std::vector<Twins> twins = {};
    double variance = 0.0, light = 0.0, rays = 0.0;  // of its paths
};

OfPixel walk_in_pixel(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const TreeRatios& ratios,
                      std::uint32_t number, std::uint32_t samples, std::uint64_t seed, bool learns) {
    const Pixel pixel = pixel_of(scene.film, number);
    std::vector<Sampler> samplers(samples, Sampler(seed, number));
    std::vector<CameraRay> camera;
    std::vector<double> weights;
    for (std::uint32_t i = 0; i < samples; ++i) {
        samplers[i].start(i);
        const CameraSample sample = sample_camera(scene, pixel.x, pixel.y, samplers[i]);
        camera.push_back(sample.ray);
        weights.push_back(sample.weight);
    }
    const std::size_t quantities = static_cast<std::size_t>(settings.bounces) + 2;
    std::vector<Rgb> found(samples * quantities, Rgb(0.0));
    std::vector<std::uint64_t> rays(quantities);
    TermSamples out{found, rays};
    TreeWalkers walkers;
    for (std::uint32_t i = 0; learns && i < samples; ++i) walkers.splits_at.push_back(1 + static_cast<int>(i) % settings.bounces);
    Branches::Log log;
    walk_tree(scene, direct, settings, ratios, std::span<const CameraRay>(camera), std::span(samplers), walkers, out,
              Branches(*ratios.of_places, log));
    // Branches come after the one that they part from.
    for (std::size_t k = log.all.size(); k-- > 0;)
        if (const std::uint32_t parent = log.parent[k]; parent != Branches::none) {
            log.all[parent].found += log.all[k].found;
            log.all[parent].rays += log.all[k].rays;
        }
    OfPixel result{std::move(log.all)};
    for (const std::uint32_t k : log.twins) {
        const Branch &a = result.branches[k - 1], &b = result.branches[k];
        result.twins.push_back({a.key, a.weight2, glm::dot(a.found, b.found)});
    }
    Rgb sum(0.0), squares(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const auto first = found.begin() + static_cast<std::ptrdiff_t>(i * quantities);
        const Rgb x = weights[i] * std::accumulate(first, first + static_cast<std::ptrdiff_t>(quantities), Rgb(0.0));
        sum += x;
        squares += x * x;
    }
    const double n = samples;
    result.variance = std::max((glm::dot(squares, Rgb(1.0)) - glm::dot(sum, sum) / n) / (n - 1.0), 0.0);
    result.light = glm::length(sum) / n;
    result.rays = static_cast<double>(std::accumulate(rays.begin(), rays.end(), std::uint64_t{0})) / n;
    return result;
}

std::unordered_map<PlaceRatios::Key, PlaceRatios::Moments> moments_of(const std::vector<OfPixel>& pixels) {
    struct Sums {
        double weight2 = 0.0, squares = 0.0, rays = 0.0, twins_weight2 = 0.0, products = 0.0;
        Rgb found{0.0};
        std::uint32_t branches = 0, twins = 0;
    };
    std::unordered_map<PlaceRatios::Key, Sums> sums;
    for (const OfPixel& pixel : pixels) {
        for (const Branch& b : pixel.branches) {
            Sums& s = sums[b.key];
            s.weight2 += b.weight2;
            s.squares += glm::dot(b.found, b.found);
            s.found += b.found * std::sqrt(b.weight2);
            s.rays += b.rays;
            ++s.branches;
        }
        for (const Twins& t : pixel.twins) {
            Sums& s = sums[t.key];
            s.twins_weight2 += t.weight2;
            s.products += t.product;
            ++s.twins;
        }
    }
    std::unordered_map<PlaceRatios::Key, PlaceRatios::Moments> moments;
    for (const auto& [key, s] : sums) {
        if (s.branches < fewest_branches || !(s.weight2 > 0.0) || !(s.rays > 0.0)) continue;
        const double second = s.squares / s.weight2,
                     variance = s.twins < fewest_branches ? 0.0 : std::max(second - s.products / s.twins_weight2, 0.0);
        moments.emplace(key, PlaceRatios::Moments{second, variance, glm::length(s.found) / s.weight2, s.rays / s.branches});
    }
    return moments;
}

PlaceCells cells_of(const Scene& scene, int bounces, std::uint64_t seed, const Watch& watch) {
    constexpr std::uint32_t walks = 4;
    std::vector<Vec3> places;
    for (const auto& of_pixel : vertices_of_walks(scene, bounces, walks, seed, watch))
        for (const WalkVertex& v : of_pixel) places.push_back(v.x.position);
    return {places, cubes_along};
}

}  // namespace

PlacePilot learn_place_ratios(const Scene& scene, int bounces, std::uint64_t seed, const Watch& watch) {
    const WalkSettings settings{.bounces = bounces, .rest_probability = 0.0};
    const DirectLightSampler direct(scene, settings.direct);
    const auto pixels = static_cast<std::uint32_t>(scene.film.crop_width * scene.film.crop_height);
    const PlaceCells cells = cells_of(scene, bounces, seed, watch);
    PlacePilot pilot{PlaceRatios(cells, bounces)};
    for (std::size_t round = 0; round <= rounds.size(); ++round) {
        const bool learns = round < rounds.size();
        const std::uint32_t samples = learns ? rounds[round] : rounds[0];
        TreeRatios ratios;
        ratios.of_places = pilot.ratios;
        // Added up in the order of pixels, so that the sums do not depend on the number of threads.
        std::vector<OfPixel> of_pixels(pixels);
        oneapi::tbb::parallel_for(std::uint32_t{0}, pixels, [&](std::uint32_t number) {
            if (watch.stop()) return;
            of_pixels[number] = walk_in_pixel(scene, direct, settings, ratios, number, samples, seed + 1 + round, learns);
        });
        if (watch.stop()) throw Stopped();
        double light = 0.0, variance = 0.0;
        pilot.rays = 0.0;
        for (const OfPixel& pixel : of_pixels) {
            light += pixel.light / pixels;
            pilot.rays += pixel.rays / pixels;
        }
        pilot.all_rays += static_cast<std::uint64_t>(pilot.rays * pixels * samples);
        const double dark = darkness * light;
        for (const OfPixel& pixel : of_pixels) variance += pixel.variance / (std::pow(pixel.light + dark, 2) * pixels);
        if (learns && variance > 0.0 && std::isfinite(variance))
            pilot.ratios = PlaceRatios(cells, bounces, moments_of(of_pixels), pilot.rays / variance, dark);
    }
    return pilot;
}

}  // namespace neumann
