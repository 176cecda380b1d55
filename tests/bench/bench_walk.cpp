// How much of bare Embree's speed the walk keeps: the walk of a picture, and the same rays cast again with nothing around them, in
// one run. In between stand the parts: the rays as Geometry casts them (hits put back onto the double geometry, offsets), the
// random numbers alone, the moments alone; what is left is shading.
#include "bench_scenes.h"
#include "core/geometry/ray_caster.h"
#include "operators/paths/walk/walk.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "recorded_rays.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <sys/resource.h>
#include <algorithm>
#include <map>
#include <numeric>

namespace {

using namespace neumann;

struct Setup {
    std::string name;
    Scene scene;
    SamplerKind sampler;
    PictureSampler::Settings settings;
    RecordingTransport rays;
    std::uint64_t numbers = 0;  // drawn by the walk

    Setup(std::string n, Scene s, SamplerKind kind) : name(std::move(n)), scene(std::move(s)), sampler(kind), rays(scene.geometry) {
        settings.sampler = kind;
        settings.walk.bounces = 8;
        settings.walk.rest_probability = 0.0;
        record(kind);
    }

    SobolPoints points{8};

    // What PictureSampler does for one replicate, with the rays taken down.
    void record(SamplerKind kind) {
        struct Counting {
            Sampler sampler;
            std::uint64_t* count;
            double next() { return ++*count, sampler.next(); }
            Vec2 next2() { return *count += 2, sampler.next2(); }
        };
        constexpr std::uint32_t pixels_at_once = 4;
        const std::size_t size = settings.replicate_size, walks = size * pixels_at_once;
        std::vector<Rgb> samples(10 * walks);
        std::vector<std::uint64_t> counts(10);
        TermSamples result{samples, counts};
        Walkers walkers;
        const DirectLightSampler direct(scene, settings.walk.direct);
        const Film& film = scene.film;
        for (std::uint32_t first = 0; first < static_cast<std::uint32_t>(film.width * film.height); first += pixels_at_once) {
            std::vector<Counting> samplers;
            std::vector<CameraRay> camera_rays;
            for (std::uint32_t pixel = first; pixel < first + pixels_at_once; ++pixel) {
                samplers.resize(samplers.size() + size, Counting{Sampler(kind, points, 0, pixel), &numbers});
                for (std::size_t i = 0; i < size; ++i) {
                    Counting& sampler = samplers[camera_rays.size()];
                    sampler.sampler.start(i);
                    const int x = static_cast<int>(pixel) % film.width, y = static_cast<int>(pixel) / film.width;
                    camera_rays.push_back(scene.camera.ray(film.sample(sampler.next2(), x, y).position));
                }
            }
            walk(scene, rays, direct, settings.walk, std::span<const CameraRay>(camera_rays), std::span(samplers), walkers, result);
        }
    }
};

void finish(benchmark::State& state, const Setup& setup) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(setup.rays.bare.size()));
}

oneapi::tbb::global_control limit(const benchmark::State& state) {
    return {oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(0))};
}

void bare(benchmark::State& state, const Setup& setup) {
    const auto control = limit(state);
    for (auto _ : state)
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, setup.rays.bare.size(), 4096), [&](const auto& range) {
            benchmark::DoNotOptimize(cast_bare(setup.scene.geometry, setup.rays.bare, range.begin(), range.end()));
        });
    finish(state, setup);
}

std::uint32_t cast(const Geometry& T, const RecordingTransport& recorded, const GeometryPacket& packet) {
    const GeometryQuery* queries = recorded.queries.data() + packet.begin;
    SurfacePoint hits[RayCaster::packet_size];
    const auto hit = [&](std::size_t i) -> SurfacePoint& { return hits[i]; };
    switch (packet.kind) {
        case GeometryPacket::Kind::camera: {
            Ray rays[RayCaster::packet_size];
            for (std::size_t i = 0; i < packet.n; ++i) rays[i] = queries[i].ray;
            return T.first_hits(std::span<const Ray>(rays, packet.n), hit);
        }
        case GeometryPacket::Kind::surface:
            return T.first_hits(
                packet.n,
                [&](std::size_t i) {
                    return std::pair<const SurfacePoint&, const Vec3&>(queries[i].from, queries[i].ray.direction);
                },
                hit);
        case GeometryPacket::Kind::visibility:
            return T.visible(
                packet.n,
                [&](std::size_t i) { return std::pair<const SurfacePoint&, const SurfacePoint&>(queries[i].from, queries[i].to); },
                packet.rays);
    }
    return 0;
}

void geometry(benchmark::State& state, const Setup& setup) {
    const auto control = limit(state);
    for (auto _ : state)
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, setup.rays.packets.size(), 512),
                                  [&](const auto& range) {
                                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                                          benchmark::DoNotOptimize(cast(setup.scene.geometry, setup.rays, setup.rays.packets[i]));
                                  });
    finish(state, setup);
}

void draw(Sampler sampler, std::uint32_t samples, std::uint64_t numbers) {
    for (std::uint32_t i = 0; i < samples; ++i) {
        sampler.start(i);
        for (std::uint64_t n = 0; n < numbers; ++n) benchmark::DoNotOptimize(sampler.next());
    }
}

void numbers(benchmark::State& state, const Setup& setup) {
    const auto control = limit(state);
    const auto pixels = static_cast<std::uint32_t>(setup.scene.film.width * setup.scene.film.height);
    const std::uint64_t each = setup.numbers / (pixels * setup.settings.replicate_size);
    for (auto _ : state)
        oneapi::tbb::parallel_for(0u, pixels, [&](std::uint32_t pixel) {
            draw(Sampler(setup.sampler, setup.points, 0, pixel), setup.settings.replicate_size, each);
        });
    finish(state, setup);
}

void whole_walk(benchmark::State& state, const Setup& setup) {
    const auto control = limit(state);
    const PictureSampler sampler(setup.scene, setup.settings);
    std::vector<double> memory;
    std::uint64_t rays = 0;
    for (auto _ : state) {
        Tally tally(sampler.quantities());
        memory = std::move(sampler.run(0, 4, tally, {}, std::move(memory))->data);
        rays += std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0});
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(rays));
}

// Keeps rays per second by benchmark name, the best of the repetitions.
class Collector : public benchmark::ConsoleReporter {
public:
    Collector() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            const auto rate = run.counters.find("items_per_second");
            if (rate == run.counters.end()) continue;
            double& best = rates[run.run_name.function_name + "/" + run.run_name.args];
            best = std::max(best, static_cast<double>(rate->second));
        }
        ConsoleReporter::ReportRuns(runs);
    }
    std::map<std::string, double> rates;
};

}  // namespace

int main(int argc, char** argv) {
    // Interleaved, so that a machine whose speed drifts slows all parts alike.
    std::vector<char*> arguments(argv, argv + argc);
    char interleave[] = "--benchmark_enable_random_interleaving=true";
    arguments.insert(arguments.begin() + 1, interleave);
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    std::vector<std::unique_ptr<Setup>> setups;
    setups.push_back(std::make_unique<Setup>("cornell-box, independent", cornell_box(), SamplerKind::independent));
    setups.push_back(std::make_unique<Setup>("cornell-box, sobol", cornell_box(), SamplerKind::sobol));
    setups.push_back(std::make_unique<Setup>("131,072 triangles, independent", landscape(256), SamplerKind::independent));
    setups.push_back(std::make_unique<Setup>("131,072 triangles, sobol", landscape(256), SamplerKind::sobol));
    const std::map<std::string, void (*)(benchmark::State&, const Setup&)> parts{
        {"bare", bare}, {"geometry", geometry}, {"numbers", numbers}, {"walk", whole_walk}};
    for (const auto& setup : setups)
        for (const char* part : {"bare", "geometry", "numbers", "walk"})
            benchmark::RegisterBenchmark((setup->name + ": " + part).c_str(),
                                         [f = parts.at(part), s = setup.get()](benchmark::State& state) { f(state, *s); })
                ->Arg(1)
                ->Arg(2)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond)
                ->Repetitions(9)
                ->MinTime(0.01);
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);

    fmt::print("\n{}, robust scene; compiled with {}\n", embree_version(), NEUMANN_CXX_FLAGS);
    fmt::print(
        "Walk: 32 samples, bounces 0..8, multiple importance sampling, no rest. Best of 9, million rays a second; shares of the "
        "walk's time.\n\n");
    fmt::print("{:<34} {:>7} {:>8} {:>8} {:>10} | {:>6} {:>9} {:>8} {:>8}\n", "scene, numbers", "threads", "bare", "walk",
               "walk/bare", "bare", "+geometry", "numbers", "shading");
    for (const auto& setup : setups)
        for (const int threads : {1, 2}) {
            const auto rate = [&](const char* part) {
                return collector.rates[fmt::format("{}: {}/{}", setup->name, part, threads)];
            };
            const double walk = rate("walk"), bare = walk / rate("bare"), geometry = walk / rate("geometry"),
                         numbers = walk / rate("numbers");
            if (walk == 0.0) continue;
            fmt::print("{:<34} {:>7} {:>8.2f} {:>8.2f} {:>10.3f} | {:>5.0f}% {:>8.0f}% {:>7.0f}% {:>7.0f}%\n", setup->name, threads,
                       rate("bare") / 1e6, walk / 1e6, bare, 100 * bare, 100 * (geometry - bare), 100 * numbers,
                       100 * (1 - geometry - numbers));
        }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    for (const auto& setup : setups) {
        const double samples = setup->scene.film.width * setup->scene.film.height * setup->settings.replicate_size;
        const double walk = collector.rates[fmt::format("{}: walk/1", setup->name)];
        if (walk > 0.0)
            fmt::print("{}: {:.2f} rays and {:.0f} ns a camera sample on one thread\n", setup->name,
                       static_cast<double>(setup->rays.bare.size()) / samples,
                       1e9 * static_cast<double>(setup->rays.bare.size()) / samples / walk);
    }
    fmt::print("peak memory {:.0f} MiB, most of it recorded rays\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
}
