// What it brings to use the tails of other walks (operators/paths/reuse/reusing_walk.h), by the number of pixels in a row that do:
// efficiency, 1 / (squared error of a pixel × cost), of bounces 2 … 5 and of the sum, beside that of walks which share nothing,
// with costs in rays and in processor time.
//
//     bench_reuse [RESOLUTION [SAMPLES]] [SCENE.xml …]
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/from_paths/walk_paths.h"
#include "tests/bench/bench_arguments.h"

#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace neumann;

constexpr int bounces = 5;

struct Work {
    std::vector<double> squared_error;  // of bounces 2 … 5 and of the sum
    double rays = 0.0, seconds = 0.0;
};

Work measure(const Scene& scene, std::uint32_t sharing, std::uint32_t samples) {
    SamplingSettings settings{.walk = {.bounces = bounces, .rest_probability = 0.0}, .seed = 1, .replicate_size = 16};
    settings.method = std::make_shared<const WalkPaths>(sharing);
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments series(sampler.width(), sampler.height(), sampler.quantities());
    const std::clock_t begin = std::clock();
    series.add(*sampler.run(0, samples / settings.replicate_size, tally));
    Work work;
    work.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    work.rays = static_cast<double>(std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0}));
    const auto result = series.result();
    const auto add = [&](const Estimate& picture) {
        double sum = 0.0;
        for (const Rgb& error : picture.standard_error.pixels) sum += glm::dot(error, error);
        work.squared_error.push_back(sum);
    };
    for (std::size_t k = 2; k <= bounces; ++k) add(result.term(k));
    add(result.sum(bounces));
    return work;
}

}  // namespace

int main(int argc, char** argv) {
    const auto [resolution, samples, paths] = BenchArguments(argc, argv, "64", 1024);
    fmt::print("{:16} pixels   by rays: bounce 2     3     4     5   sum   by time:    2     3     4     5   sum\n", "");
    for (const std::string& path : paths) {
        const Scene scene = read_scene(path, {{"res", resolution}});
        const Work alone = measure(scene, 1, samples);
        for (const std::uint32_t sharing : {4u, 8u, 16u}) {
            const Work together = measure(scene, sharing, samples);
            std::string line = fmt::format("{:16} {:6}          ", std::filesystem::path(path).stem().string(), sharing);
            for (const double cost : {together.rays / alone.rays, together.seconds / alone.seconds}) {
                line += "     ";
                for (std::size_t k = 0; k < alone.squared_error.size(); ++k)
                    line += fmt::format(" {:5.2f}", alone.squared_error[k] / (together.squared_error[k] * cost));
            }
            fmt::print("{}\n", line);
        }
    }
}
