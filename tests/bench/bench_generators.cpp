// The path generators beside each other, in one run: rays per second of each as a share of the fastest one's, and how many times
// more efficient than the plain walk it is in each bounce, 1 / (variance × time). Variance is of pixels, averaged over picture and
// channels; time is that of sampling, and with what is set up before for runs of so many seconds.
//
//     bench_generators [SCENE.xml [RESOLUTION [SECONDS]]]
#include "core/reader/read_scene.h"
#include "operators/paths/guided/guide.h"
#include "operators/render/from_paths/guided_paths.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "tests/physics/paths_of.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

namespace {

using namespace neumann;

constexpr int bounces = 6;
constexpr std::uint64_t repetitions = 32;  // of a replicate each, the generators in turn

double seconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Generator {
    const char* name;
    SamplingSettings settings;
    double setup = 0.0;
    std::unique_ptr<PictureSampler> sampler{};
    std::unique_ptr<SeriesMoments> moments{};
    double fastest = 1e300;  // seconds of one repetition
    std::uint64_t rays = 0;  // of one repetition
    std::vector<double> memory{};
};

double mean_variance(const SeriesMoments::Result& result, std::size_t bounce) {
    const Image error = result.term(bounce).standard_error;
    double sum = 0.0;
    for (const Rgb& e : error.pixels) sum += glm::dot(e, e);
    return sum / (3.0 * static_cast<double>(error.pixels.size()));
}

}  // namespace

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[1] : SCENES "/cornell-box/cornell-box.xml";
    const std::string resolution = argc > 2 ? argv[2] : "128";
    const double seconds = argc > 3 ? std::stod(argv[3]) : 20.0;
    const Scene scene = read_scene(path, {{"res", resolution}});

    std::vector<Generator> generators;
    const std::pair<const char*, std::shared_ptr<const PathMethod>> methods[] = {
        {"walk", plain_walks()},
        {"guided", nullptr},  // made below
        {"surface", physics::paths_of(method::Surface{})},
        {"classic", physics::paths_of(method::Classic{})},
        {"light", std::make_shared<const LightPaths>()},
        {"bidirectional", std::make_shared<const BidirectionalPaths>()}};
    for (const auto& [name, method] : methods) {
        Generator g{.name = name, .settings = {}};
        g.settings.replicate_size = largest_replicate;
        g.settings.walk.bounces = bounces;
        if (method)
            g.settings.method = method;
        else
            g.setup = seconds_of([&] {
                GuideSettings guide;
                guide.bounces = bounces;
                g.settings.method = std::make_shared<const GuidedPaths>(std::make_shared<const Guide>(scene, guide));
            });
        g.sampler = std::make_unique<PictureSampler>(scene, g.settings);
        g.moments = std::make_unique<SeriesMoments>(g.sampler->width(), g.sampler->height(), g.sampler->quantities());
        generators.push_back(std::move(g));
    }
    // In turn, so that a machine whose speed drifts slows all alike.
    for (std::uint64_t r = 0; r < repetitions; ++r)
        for (Generator& g : generators) {
            Tally tally(g.sampler->quantities());
            std::optional<MomentsNode> node;
            g.fastest = std::min(g.fastest, seconds_of([&] { node = g.sampler->run(r, 1, tally, {}, std::move(g.memory)); }));
            g.rays = std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0});
            g.memory = g.moments->add(std::move(*node));
        }

    const auto rate = [](const Generator& g) { return static_cast<double>(g.rays) / g.fastest; };
    double fastest = 0.0;
    for (const Generator& g : generators) fastest = std::max(fastest, rate(g));
    const double samples = static_cast<double>(largest_replicate) * scene.film.crop_width * scene.film.crop_height;
    fmt::print("{}, {}², bounces 0 to {}; best of {} repetitions, all threads\n\n", path, resolution, bounces, repetitions);
    fmt::print("{:<14} {:>12} {:>8} {:>14} {:>12} {:>10}\n", "", "M rays/s", "share", "rays/sample", "µs/sample", "set-up s");
    for (const Generator& g : generators)
        fmt::print("{:<14} {:>12.2f} {:>8.2f} {:>14.2f} {:>12.3f} {:>10.2f}\n", g.name, rate(g) / 1e6, rate(g) / fastest,
                   static_cast<double>(g.rays) / samples, 1e6 * g.fastest / samples, g.setup);

    fmt::print("\nefficiency over walk, of {:.0f} s with set-up (and variance over walk's at equal samples)\n\n{:<14}", seconds,
               "");
    for (int i = 1; i <= bounces; ++i) fmt::print(" {:>15}", fmt::format("bounce {}", i));
    fmt::print("\n");
    const auto walk_result = generators.front().moments->result();
    for (const Generator& g : generators) {
        const auto result = g.moments->result();
        fmt::print("{:<14}", g.name);
        for (std::size_t i = 1; i <= bounces; ++i) {
            const double less = mean_variance(walk_result, i) / mean_variance(result, i);
            const double time = g.fastest / generators.front().fastest / (1.0 - g.setup / seconds);
            const bool makes_it = std::isfinite(less);
            fmt::print(" {:>15}", makes_it ? fmt::format("{:.2f} ({:.2f})", less / time, 1.0 / less) : "not made");
        }
        fmt::print("\n");
    }
}
