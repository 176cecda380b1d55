// Where the next ray is best spent: the parts of a path's variance by depth, the numbers of samples at each depth that are best for
// the sum and for each bounce, and the efficiency, 1 / (variance × rays), of other rules beside a path's, as predicted from the
// parts; and that of rules which `--split` has, as measured.
//
//     bench_split [RESOLUTION [SAMPLES]] [SCENE.xml …]
#include "core/reader/read_scene.h"
#include "operators/paths/walk/tree_pilot.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "tests/bench/bench_arguments.h"

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace {

using namespace neumann;

constexpr int bounces = 5;

std::vector<double> split_first(double walks) {
    std::vector<double> numbers(bounces + 1, walks);
    numbers[0] = 1.0;
    return numbers;
}
std::vector<double> split_everywhere(double branches) {
    std::vector<double> numbers{1.0};
    while (numbers.size() < bounces + 1) numbers.push_back(numbers.back() * branches);
    return numbers;
}

std::string print(const std::vector<double>& numbers) {
    std::string text;
    for (const double m : numbers) text += fmt::format(" {:6.2f}", m);
    return text;
}

// Variance of a sample of the sum times rays for it, of renders.
double measured(const Scene& scene, int walks, std::uint64_t samples) {
    const SamplingSettings settings{.walk = {.bounces = bounces, .split = {walks, walks}, .rest_probability = 0.0},
                                    .sampler = SamplerKind::independent,
                                    .seed = 1,
                                    .replicate_size = 1};
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments series(sampler.width(), sampler.height(), sampler.quantities());
    series.add(*sampler.run(0, samples, tally));
    double variance = 0.0;
    for (const Rgb& error : series.result().sum(bounces).standard_error.pixels) variance += glm::dot(error, error);
    return variance * static_cast<double>(std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0}));
}

}  // namespace

int main(int argc, char** argv) {
    const auto [resolution, samples, paths] = BenchArguments(argc, argv, "32", 1024);
    for (const std::string& path : paths) {
        const Scene scene = read_scene(path, {{"res", resolution}});
        const TreePilot pilot = measure_tree(scene, bounces, samples, 1);
        fmt::print("{}, {}² pixels, {} walks a pixel\n", std::filesystem::path(path).stem().string(), resolution, samples);
        const double all = std::accumulate(pilot.sum.variance.begin(), pilot.sum.variance.end(), 0.0);
        std::vector<double> parts;
        for (const double d : pilot.sum.variance) parts.push_back(100.0 * d / all);
        fmt::print("  variance of the sum by depth, %{}\n  rays by depth              {}\n", print(parts), print(pilot.sum.cost));
        fmt::print("  best numbers for the sum    {}\n", print(best_tree(pilot.sum)));
        for (std::size_t k = 1; k <= bounces; ++k)
            fmt::print("                   bounce {}  {}\n", k, print(best_tree(pilot.bounces[k])));
        const double path_work = work_of(pilot.sum, split_first(1.0)), measured_path = measured(scene, 1, samples);
        fmt::print("  efficiency for the sum, times a path's\n");
        for (const double b : {2.0, 4.0})
            fmt::print("    {:.0f} branches at every depth   {:6.2f}\n", b, path_work / work_of(pilot.sum, split_everywhere(b)));
        for (const int n : {2, 4, 8, 16})
            fmt::print("    {:2d} at the first, then one    {:6.2f}, measured {:.2f}\n", n,
                       path_work / work_of(pilot.sum, split_first(n)),
                       measured_path / measured(scene, n, std::max(samples / static_cast<std::uint32_t>(n), 64u)));
        fmt::print("    best tree                   {:6.2f}\n", path_work / work_of(pilot.sum, best_tree(pilot.sum)));
    }
}
