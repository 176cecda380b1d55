// Corrected fields beside the walk, in one run: processor time and error of both, how long each needs for a relMSE of 1e-2 and of
// 1e-3 (means over bounces 1 to 6, by their standard errors), and the standard error of the means of pictures at 1e-2.
//
//     bench_corrected [SCENE.xml [RESOLUTION [SECONDS]]]
//
// With a required ratio after the seconds it ends with 1 if the walk needs less than that many times as long for 1e-2.
#include "core/reader/read_scene.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace neumann;

constexpr int bounces = 8, first_judged = 1, last_judged = 6;
constexpr double goals[] = {1e-2, 1e-3};
constexpr std::uint64_t reference_samples = 512;

double processor_seconds() {
    rusage used;
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

struct Run {
    double seconds = 0.0, error = 0.0, error_of_mean = 0.0, rays = 0.0;
    std::vector<double> errors;
};

// The standard errors' squares relative to a reference of little noise: a picture's own means are large where its noise is.
double relative_squares(const PixelEstimate& term, const Image& reference) {
    double mean = 0.0, sum = 0.0;
    const auto n = static_cast<double>(reference.pixels.size());
    for (const Rgb& x : reference.pixels) mean += mean_component(x) / n;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = reference.pixels[i][c], e = term.standard_error.pixels[i][c];
            sum += e * e / (x * x + 1e-2 * mean * mean) / (3.0 * n);
        }
    return sum;
}

Run run(const Scene& scene, const Method& method, std::uint64_t samples, std::uint64_t seed, const std::vector<Image>& reference) {
    const double begin = processor_seconds();
    Goal goal{.bounces = bounces, .samples = samples, .seed = seed};
    goal.only_pictures = true;
    const BounceSeries series = render(scene, method, goal);
    Run found;
    found.seconds = processor_seconds() - begin;
    found.rays = static_cast<double>(series.rays);
    for (int i = first_judged; i <= last_judged; ++i) {
        const auto k = static_cast<std::size_t>(i);
        found.errors.push_back(relative_squares(series.term(k), reference[k]));
        found.error += found.errors.back() / (last_judged - first_judged + 1);
        const MeanWithError m = series.means_of_term(k).all;
        found.error_of_mean = std::max(found.error_of_mean, m.standard_error / m.mean);
    }
    return found;
}

void print(const char* name, const Run& r, std::uint64_t samples) {
    fmt::print("{:<10} {:>5} samples {:>8.3f} s {:>7.2f} M rays  relMSE {:.5f} |", name, samples, r.seconds, r.rays / 1e6, r.error);
    for (const double e : r.errors) fmt::print(" {:.5f}", e);
    fmt::print("  worst error of a mean {:.2f}%\n", 100.0 * r.error_of_mean);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[1] : SCENES "/mitsuba-cornell/mitsuba-cornell.xml";
    const std::string resolution = argc > 2 ? argv[2] : "256";
    const std::uint64_t walk_samples = argc > 3 ? std::stoull(argv[3]) : 64;
    const Scene scene = read_scene(path, {{"res", resolution}});
    std::vector<Image> reference;
    {
        Goal goal{.bounces = bounces, .samples = reference_samples, .seed = 2};
        goal.only_pictures = true;
        const BounceSeries series = render(scene, method::Corrected{}, goal);
        for (int i = 0; i <= bounces; ++i) reference.push_back(series.term(static_cast<std::size_t>(i)).mean);
    }
    const Run walk = run(scene, method::Walk{}, walk_samples, 1, reference);
    print("walk", walk, walk_samples);
    double least = 1e300;
    for (const double goal : goals) {
        // Doubles the samples of its four replicates until the goal is reached; between the last two the seconds are linear in
        // 1 / error, because some of them do not depend on samples.
        Run before;
        for (std::uint64_t samples = 4;; samples *= 2) {
            const Run r = run(scene, method::Corrected{}, samples, 1, reference);
            print("corrected", r, samples);
            if (r.error > goal && samples < 1024) {
                before = r;
                continue;
            }
            const double walk_needs = walk.seconds * walk.error / goal;
            double needs = r.seconds;
            if (before.error > r.error)
                needs += (before.seconds - r.seconds) * (1.0 / r.error - 1.0 / goal) / (1.0 / r.error - 1.0 / before.error);
            fmt::print("{:g}: the walk needs {:.2f} s, corrected fields {:.2f}: {:.1f} times\n", goal, walk_needs, needs,
                       walk_needs / needs);
            least = std::min(least, walk_needs / needs);
            break;
        }
    }
    if (argc > 4 && least < std::stod(argv[4])) {
        fmt::print("less than the {} asked for\n", argv[4]);
        return 1;
    }
}
