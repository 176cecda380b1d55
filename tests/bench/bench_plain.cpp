// What a sample of the walk costs, as a multiple of that of a plain tracer (plain_tracer.h) with the same estimator and the same
// number of samples: scenes/mitsuba-cornell at 256², bounces 0 to 8, 64 samples. Measured in turn: the plain tracer; the sampling
// of a picture, with its moments and no rest; and a whole render() with all that a render does, among it the rest. Ratios are
// medians over the repetitions, of seconds of the processor.
//
// Then the pictures are compared: the means of all bounces by z-tests. Exit code 1 if they differ, or if a ratio is more than 10%
// above the figure recorded below.
//
//     bench_plain [REPETITIONS [THREADS]]
#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/methods/render.h"
#include "plain_tracer.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>
#include <algorithm>
#include <numeric>
#include <string>

namespace {

using namespace neumann;

constexpr int bounces = 8, samples = 64;
// As apps/manual/speed.md has them.
constexpr double recorded_walk = 1.65, recorded_render = 2.03, tolerance = 1.1;

// Of this process, for other programs may have the processor in between.
double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double median(std::vector<double> x) {
    const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
    std::nth_element(x.begin(), middle, x.end());
    return *middle;
}

struct Runs {
    std::vector<double> seconds, wall;  // of each repetition
    std::uint64_t rays = 0;

    template <class F>
    void once(const F& f) {
        const Stopwatch clock;
        const double begin = processor_seconds();
        rays = f();
        seconds.push_back(processor_seconds() - begin);
        wall.push_back(clock.seconds());
    }
    double ratio_to(const Runs& other) const {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < seconds.size(); ++i) ratios.push_back(seconds[i] / other.seconds[i]);
        return median(ratios);
    }
    void print(const char* name, const Runs& plain, double camera_samples) const {
        const double s = median(seconds);
        fmt::print("{:<28} {:>8.3f} {:>8.3f} {:>7.1f} {:>9.2f} {:>9.0f} {:>8.2f}\n", name, s, median(wall),
                   static_cast<double>(rays) / camera_samples, static_cast<double>(rays) / s / 1e6, 1e9 * s / camera_samples,
                   ratio_to(plain));
    }
};

// Largest |z| of the means of all bounces and channels: 27 comparisons, so |z| > 4.5 is a false alarm in 5,000 runs. The plain
// tracer's errors are from 64 runs of one sample, the walk's from the spread of each pixel's replicates.
double largest_z(const PlainTracer& plain, std::size_t pixels, const SeriesMoments& walk) {
    const std::size_t quantities = bounces + 1;
    std::vector<std::vector<Rgb>> means;  // by run and bounce
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
        const auto pictures = plain.render(bounces, 1, seed);
        means.emplace_back(quantities, Rgb(0.0));
        for (std::size_t i = 0; i < pictures.of.size(); ++i)
            means.back()[i % quantities] += Rgb(pictures.of[i]) / static_cast<double>(pixels);
    }
    const auto result = walk.result();
    double largest = 0.0;
    fmt::print("\n{:<7} {:>12} {:>12} {:>8} {:>8}\n", "bounce", "plain", "walk", "SE", "z");
    for (std::size_t q = 0; q < quantities; ++q)
        for (int c = 0; c < 3; ++c) {
            double mean = 0.0, squares = 0.0;
            for (const auto& run : means) mean += run[q][c] / 64.0;
            for (const auto& run : means) squares += (run[q][c] - mean) * (run[q][c] - mean);
            const MeanWithError of_walk = result.means_of_term(q).channel[c];
            const double error = std::hypot(std::sqrt(squares / (64.0 * 63.0)), of_walk.standard_error),
                         z = (of_walk.mean - mean) / error;
            fmt::print("{:<7} {:>12.6f} {:>12.6f} {:>7.3f}% {:>8.2f}\n", c == 0 ? std::to_string(q) : "", mean, of_walk.mean,
                       100.0 * error / mean, z);
            largest = std::max(largest, std::abs(z));
        }
    return largest;
}

}  // namespace

int main(int argc, char** argv) {
    const int repetitions = argc > 1 ? std::stoi(argv[1]) : 9, threads = argc > 2 ? std::stoi(argv[2]) : 1;
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
    const Scene scene = read_scene(SCENES "/mitsuba-cornell/mitsuba-cornell.xml", {});
    const std::size_t pixels = static_cast<std::size_t>(scene.film.width) * static_cast<std::size_t>(scene.film.height);
    const PlainTracer plain(scene);
    const std::uint32_t size = replicate_size(samples);
    const PictureSampler sampler(scene, {.walk = {.bounces = bounces, .rest_probability = 0.0}, .replicate_size = size});
    SeriesMoments moments(scene.film.width, scene.film.height, sampler.quantities());

    Runs of_plain, of_walk, of_render;
    std::vector<double> memory;
    for (int r = 0; r < repetitions; ++r) {
        of_plain.once([&] { return plain.render(bounces, samples, static_cast<std::uint64_t>(r)).rays; });
        of_walk.once([&] {
            Tally tally(sampler.quantities());
            SeriesMoments fresh(scene.film.width, scene.film.height, sampler.quantities());
            memory = fresh.add(*sampler.run(0, samples / size, tally, {}, std::move(memory)));
            moments = std::move(fresh);
            return std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0});
        });
        of_render.once([&] { return render(scene, method::Walk{}, {.bounces = bounces, .samples = samples}).rays; });
    }
    const double camera_samples = static_cast<double>(pixels) * samples;
    fmt::print("{} threads, {} repetitions\n\n{:<28} {:>8} {:>8} {:>7} {:>9} {:>9} {:>8}\n", threads, repetitions, "", "seconds",
               "wall", "rays", "M rays/s", "ns", "ratio");
    of_plain.print("plain tracer", of_plain, camera_samples);
    of_walk.print("sampling of the walk", of_plain, camera_samples);
    of_render.print("render() of the walk", of_plain, camera_samples);
    const double z = largest_z(plain, pixels, moments), walk = of_walk.ratio_to(of_plain), whole = of_render.ratio_to(of_plain);
    const bool same = z <= 4.5, fast = walk <= tolerance * recorded_walk && whole <= tolerance * recorded_render;
    fmt::print("\nlargest |z| of 27: {:.2f}{}\n", z, same ? "" : ", the pictures differ");
    fmt::print("ratios: {:.2f} ({:.2f} recorded), {:.2f} ({:.2f} recorded){}\n", walk, recorded_walk, whole, recorded_render,
               fast ? "" : ": slower");
    return same && fast ? 0 : 1;
}
