// How much faster fields on patches are than the walk, for the same error of all bounce pictures: scenes/mitsuba-cornell at 256²,
// bounces 0 … 8, from the scene loaded to the pictures in memory, both in this run. The error is relMSE (metrics.h) averaged over
// bounces 1 … 6, less what the reference's own noise adds.
//
//     bench_matrix [samples]     of the reference, 512 without; it is kept in $XDG_CACHE_HOME/neumann or ~/.cache/neumann
//
// The walk would need hours for a reference of a twentieth of the smallest error here, so it is made by `gather` from 60 times as
// many patches as its finest competitor has, with other seeds. That it is right is seen beside it: the walk's relMSE against it
// should be what the walk's own standard errors say.
//
// Then: one application of K beside copying memory, tracing T beside bare Embree's rays, and both by number of patches.
#include "core/base/stopwatch.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"
#include "operators/algebra/algebra.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/statistics/metrics.h"
#include "tests/bench/recorded_rays.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace neumann {
namespace {

constexpr int bounces = 8;

RenderedSeries walk(const Scene& scene, std::uint64_t samples, std::uint64_t seed) {
    PictureSampler::Settings settings;
    settings.walk.bounces = bounces;
    settings.walk.rest_probability = 0.0;
    settings.replicate_size = replicate_size(samples);
    settings.seed = seed;
    return render_series(scene, settings, {samples, {}, {}});
}

std::vector<Estimate> reference(const Scene& scene, std::uint32_t samples) {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const std::filesystem::path folder =
        (cache ? std::filesystem::path(cache) : std::filesystem::path(home ? home : ".") / ".cache") / "neumann" /
        fmt::format("mitsuba-cornell-{}-gather-{}", scene.hash, samples);
    const auto file = [&](int i) { return (folder / fmt::format("{}.exr", i)).string(); };
    std::vector<Estimate> result;
    if (!std::filesystem::exists(file(bounces))) {
        fmt::print("The reference, {} samples a pixel: kept in {}\n", samples, folder.string());
        FieldSettings settings;
        settings.reading = FieldReading::gather;
        settings.bounces = bounces;
        settings.patching = {250'000, 0.5};
        settings.replicates = 4;
        settings.rays = 256;
        settings.light_samples = 64;
        settings.samples = samples / settings.replicates;
        settings.gather_rays = 8;
        settings.seed = 4242;
        settings.rest = false;
        const FieldPictures pictures = *render_fields(scene, settings);
        std::filesystem::create_directories(folder);
        for (int i = 0; i <= bounces; ++i)
            std::ofstream(file(i), std::ios::binary) << encode_exr(pictures.term(static_cast<std::size_t>(i)));
    }
    for (int i = 0; i <= bounces; ++i) result.push_back(read_exr(file(i)));
    return result;
}

// Of a picture whose values are `truth`'s: what noise and patches are said to add to relMSE.
struct Expected {
    double noise = 0.0, discretisation = 0.0;
};
Expected expected(const Estimate& picture, const Image& truth) {
    double mean = 0.0;
    for (const Rgb& p : truth.pixels) mean += (p.r + p.g + p.b) / (3.0 * static_cast<double>(truth.pixels.size()));
    Expected e;
    for (std::size_t pixel = 0; pixel < truth.pixels.size(); ++pixel)
        for (int c = 0; c < 3; ++c) {
            const double value = truth.pixels[pixel][c], se = picture.standard_error.pixels[pixel][c];
            const double per =
                1.0 / ((value * value + metrics_epsilon * mean * mean) * 3.0 * static_cast<double>(truth.pixels.size()));
            e.noise += se * se * per;
            if (picture.discretisation.pixels.empty()) continue;
            const double d = picture.discretisation.pixels[pixel][c];
            e.discretisation += d * d * per;
        }
    return e;
}

// Means over bounces 1 … 6: relMSE, what is expected of the picture itself, and what the reference adds.
struct Error {
    double found = 0.0;
    Expected own, reference;
    double corrected() const { return found - reference.noise; }
};
template <class Term>
Error error(const std::vector<Estimate>& reference, const Term& term) {
    Error e;
    for (std::size_t i = 1; i <= 6; ++i) {
        const Image& exact = reference[i].mean;
        const Estimate picture = term(i);
        e.found += compare(picture.mean, exact).rel_mse / 6.0;
        const Expected own = expected(picture, exact), other = expected(reference[i], exact);
        e.own.noise += own.noise / 6.0;
        e.own.discretisation += own.discretisation / 6.0;
        e.reference.noise += other.noise / 6.0;
        e.reference.discretisation += other.discretisation / 6.0;
    }
    return e;
}

void compare_methods(const Scene& scene, std::uint32_t samples) {
    const std::vector<Estimate> exact = reference(scene, samples);
    const Stopwatch walk_watch;
    const RenderedSeries walked = walk(scene, 64, 11);
    const double walk_seconds = walk_watch.seconds();
    const auto result = walked.moments.result();
    const Error walk_error = error(exact, [&](std::size_t i) { return result.term(i); });
    fmt::print("reference: its noise adds {:.6f}, subtracted; its patches {:.6f} at most, which is not\n",
               walk_error.reference.noise, walk_error.reference.discretisation);
    fmt::print("walk, 64 Sobol' samples: relMSE {:.4f}, by its own standard errors {:.4f}; {:.3f} s\n", walk_error.corrected(),
               walk_error.own.noise, walk_seconds);
    // The walk's relMSE falls as 1 / samples.
    const auto walk_needs = [&](double target) { return walk_seconds * walk_error.corrected() / target; };
    fmt::print("{:>8}  {:>8} {:>6} {:>6} {:>7}  {:>8}  {:>9}  {:>9}  {:>9}\n", "method", "patches", "rays", "spp", "gather",
               "relMSE", "fields s", "all s", "of walk's");
    const auto measure = [&](FieldReading method, std::size_t patches, std::uint32_t rays, std::uint32_t spp, std::uint32_t gather,
                             int N = bounces) {
        FieldSettings settings;
        settings.reading = method;
        settings.bounces = N;
        settings.patching = {patches, 0.5};
        settings.rays = rays;
        settings.light_samples = std::min(rays, 64u);
        settings.samples = spp;
        settings.gather_rays = gather;
        settings.replicates = 2;
        settings.rest = false;
        double best = 1e9, fields = 0.0;
        std::optional<FieldPictures> pictures;
        for (int i = 0; i < 5; ++i) {
            const Stopwatch watch;
            pictures = render_fields(scene, settings);
            for (int k = 0; k <= N; ++k) pictures->term_mean(static_cast<std::size_t>(k));
            const double seconds = watch.seconds();
            if (seconds < best) {
                best = seconds;
                fields = pictures->field_seconds;
            }
        }
        const Error e = error(exact, [&](std::size_t i) { return pictures->term(i); });
        fmt::print("{:>8}  {:>8} {:>6} {:>6} {:>7}  {:>8.5f}  {:>9.4f}  {:>9.4f}  1/{:<7.0f}\n",
                   method == FieldReading::matrix ? "matrix" : "gather", pictures->patches, rays * 2, spp * 2,
                   method == FieldReading::gather ? fmt::format("{}", gather) : "", e.corrected(), fields, best,
                   walk_needs(e.corrected()) / best);
        return best;
    };
    measure(FieldReading::matrix, 1000, 32, 4, 0);
    measure(FieldReading::matrix, 2000, 64, 4, 0);
    measure(FieldReading::matrix, 4000, 128, 16, 0);
    measure(FieldReading::gather, 1000, 32, 8, 4);
    measure(FieldReading::gather, 4000, 64, 32, 4);
    const auto many_pictures = [&](std::size_t patches, std::uint32_t rays, std::uint32_t spp) {
        const double nine = measure(FieldReading::matrix, patches, rays, spp, 0),
                     many = measure(FieldReading::matrix, patches, rays, spp, 0, 64);
        fmt::print("65 pictures in {:.2f} times the time of nine\n", many / nine);
    };
    many_pictures(1000, 32, 4);
    many_pictures(4000, 128, 16);
}

// Bytes a second that all threads copy.
double copy_bandwidth() {
    constexpr std::size_t size = std::size_t{256} << 20;
    std::vector<char> from(size, 1), to(size, 2);
    double best = 0.0;
    for (int i = 0; i < 5; ++i) {
        const Stopwatch watch;
        oneapi::tbb::parallel_for(std::size_t{0}, std::size_t{64},
                                  [&](std::size_t k) { std::memcpy(&to[k * size / 64], &from[k * size / 64], size / 64); });
        best = std::max(best, static_cast<double>(size) / watch.seconds());
    }
    return best;
}

// Rays a second that Embree alone casts one by one, of such as T casts: from all over every facet, in all its directions.
double bare_rays_per_second(const Scene& scene) {
    const PatchSpace space(scene.geometry, {4000, 0.5}, side_directions(scene));
    constexpr std::uint32_t rays = 256;
    constexpr std::size_t packet = RayCaster::packet_size;
    const RecordingTransport recorder(scene.geometry);
    const SobolPoints points(rays);
    for (std::uint32_t f = 0; f < space.facets().size(); ++f) {
        Sampler sampler(points, 1, f);
        for (std::uint32_t begin = 0; begin < rays; begin += packet) {
            std::array<std::pair<SurfacePoint, Vec3>, packet> from;
            std::array<SurfacePoint, packet> hits;
            for (std::uint32_t i = 0; i < packet; ++i) {
                sampler.start(begin + i);
                const Vec3 w = cosine_hemisphere(sampler.next2());
                from[i].first = space.patches().point(space.facets()[f].patch, sampler.next2());
                from[i].second = space.frame(space.facets()[f], from[i].first).to_world(w);
            }
            recorder.first_hits(
                packet, [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[i].first, from[i].second); },
                [&](std::size_t i) -> SurfacePoint& { return hits[i]; });
        }
    }
    double best = 0.0;
    for (int run = 0; run < 5; ++run) {
        const Stopwatch watch;
        std::atomic<std::size_t> found = 0;
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, recorder.bare.size(), 4096), [&](const auto& range) {
            found += cast_bare(scene.geometry, recorder.bare, range.begin(), range.end());
        });
        if (found > 0) best = std::max(best, static_cast<double>(recorder.bare.size()) / watch.seconds());
    }
    return best;
}

void measure_operators(const Scene& scene) {
    const double bare = bare_rays_per_second(scene);
    const double bandwidth = copy_bandwidth();
    fmt::print(
        "Embree alone {:.2f} Mrays/s, memory copies {:.1f} GB/s\n{:>8} {:>9} {:>6}  {:>8} {:>8} {:>9}  {:>10} {:>12} {:>9}  "
        "{:>9}\n",
        bare * 1e-6, bandwidth * 1e-9, "patches", "unknowns", "rays", "trace s", "Mrays/s", "of bare", "K ms", "index GB/s",
        "of copy", "table MiB");
    for (const std::size_t patches : {1000u, 4000u, 16000u, 64000u, 250000u}) {
        constexpr std::uint32_t rays = 64;
        const PatchSpace space(scene.geometry, {patches, 0.5}, side_directions(scene));
        const Stopwatch trace_watch;
        const RayTable table(space, rays, 1);
        const double trace = trace_watch.seconds();
        const ReflectionMatrix<4> R(scene.materials, space);
        const auto K = R * TransportMatrix<4>(table);
        ExitantVector<4> x = emitted_light<4>(scene, space);
        const int times = static_cast<int>(std::max<std::size_t>(4, 400'000 / patches));
        double best = 1e9;
        for (int run = 0; run < 5; ++run) {
            const Stopwatch watch;
            for (int i = 0; i < times; ++i) x = K(std::move(x));
            best = std::min(best, watch.seconds() / times);
        }
        const auto entries = static_cast<double>(table.seen().size());
        fmt::print("{:>8} {:>9} {:>6}  {:>8.3f} {:>8.2f} {:>9.2f}  {:>10.3f} {:>12.2f} {:>9.2f}  {:>9}\n", space.patches().size(),
                   space.size(), rays, trace, entries / trace * 1e-6, entries / trace / bare, best * 1e3,
                   entries * 4.0 / best * 1e-9, entries * 4.0 / best / bandwidth,
                   table.seen().size() * sizeof(std::uint32_t) >> 20);
    }
}

}  // namespace
}  // namespace neumann

int main(int argc, char** argv) {
    const neumann::Scene scene = neumann::read_scene(SCENES "/mitsuba-cornell/mitsuba-cornell.xml");
    neumann::measure_operators(scene);
    neumann::compare_methods(scene, argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 512);
}
