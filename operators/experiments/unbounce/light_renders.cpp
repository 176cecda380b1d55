#include "operators/experiments/unbounce/light_renders.h"

#include "core/base/stopwatch.h"
#include "operators/experiments/unbounce/sorted_walks.h"
#include "operators/render/from_paths/pilot.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace neumann {

namespace {

constexpr std::uint64_t more_samples_forward = 4;
// The number of parts of the samples; it is smaller for many lights, because each part has a large matrix.
constexpr std::uint64_t most_parts = 32, fewest_parts = 16;
constexpr std::size_t many_lights = 256;

std::uint32_t samples_of_part(std::uint64_t samples, std::size_t lights) {
    const std::uint64_t parts = lights > many_lights ? fewest_parts : most_parts;
    auto size = static_cast<std::uint32_t>(std::bit_floor(std::max<std::uint64_t>(samples / parts, 1)));
    while (samples % size != 0) size /= 2;
    return size;
}

SamplingSettings settings_of_walks(const Scene& scene, const LightSampling& sampling, std::size_t lights) {
    const Goal goal = ProjectorLights::goal_of(0, sampling.samples, sampling.seed);
    SamplingSettings settings;
    settings.seed = goal.seed;
    settings.replicate_size = samples_of_part(sampling.samples, lights);
    settings.walk.bounces = sampling.bounces;
    const Pilot pilot(scene, {}, goal.seed, sampling.bounces);
    if (!pilot.converges())
        throw RunError(
            fmt::format("the light of all bounces is not known: {} of {} walks had not ended after {} bounces and were "
                        "given up",
                        pilot.given_up(), pilot.walks(), pilot.bounces() + Pilot::give_up));
    settings.walk.rest_probability = pilot.rest_probability(sampling.bounces);
    return settings;
}

class Parts {
public:
    explicit Parts(std::size_t size) : sums_(size, Rgb(0.0)), squares_(sums_) {}
    void add(std::size_t i, const Rgb& value) {
        sums_[i] += value;
        squares_[i] += value * value;
    }
    // The estimate from `count` parts, of entries first … of a picture of this size. One part has no finite error.
    Estimate estimate(std::size_t first, int width, int height, double count) const {
        Estimate result{Image(width, height), Image(width, height)};
        result.degrees_of_freedom = count - 1.0;
        for (std::size_t p = 0; p < result.mean.pixels.size(); ++p) {
            const Rgb mean = sums_[first + p] / count;
            const Rgb variance = glm::max(squares_[first + p] / count - mean * mean, Rgb(0.0)) / (count - 1.0);
            result.mean.pixels[p] = mean;
            result.standard_error.pixels[p] = glm::sqrt(variance);
        }
        return result;
    }

private:
    std::vector<Rgb> sums_, squares_;
};

MeanWithError mean_of(const std::vector<double>& parts) {
    const auto n = static_cast<double>(parts.size());
    double sum = 0.0, squares = 0.0;
    for (const double x : parts) sum += x / n;
    for (const double x : parts) squares += (x - sum) * (x - sum);
    return {sum, std::sqrt(squares / (n * (n - 1.0))), n - 1.0};
}

void render_pictures(const ProjectorLights& projector, const Scene& scene, const LightSampling& sampling, const Watch& watch,
                     const std::function<void(double)>& tell, LightRenders& result) {
    const SortedWalks walks(projector, scene, settings_of_walks(scene, sampling, projector.lights()));
    const std::size_t lights = projector.lights(), pixels = walks.pixels();
    const std::uint64_t parts = sampling.samples / walks.size();
    const Regions& regions = result.parts.regions = projector.regions();
    const Eigen::VectorXd sizes = regions.sizes(lights);
    Parts pictures(lights * pixels), direct(pixels);
    std::vector<std::vector<double>> of_unseen(static_cast<std::size_t>(sampling.bounces));
    for (std::uint64_t part = 0; part < parts; ++part) {
        tell(static_cast<double>(part) / static_cast<double>(parts));
        const SortedWalks::Part found = walks.sample(part, watch);
        RegionParts::Part& of_regions = result.parts.parts.emplace_back();
        of_regions.T.fill(Eigen::MatrixXd::Zero(sizes.size(), sizes.size()));
        of_regions.direct.fill(Eigen::VectorXd::Zero(sizes.size()));
        for (std::size_t p = 0; p < pixels; ++p) {
            direct.add(p, found.direct[p]);
            const int r = regions.of_pixel[p];
            for (std::size_t c = 0; c < 3; ++c) of_regions.direct[c][r] += found.direct[p][static_cast<int>(c)] / sizes[r];
            for (const auto& [light, value] : found.of_pixel[p]) {
                pictures.add(light * pixels + p, value);
                for (std::size_t c = 0; c < 3; ++c)
                    of_regions.T[c](r, static_cast<Eigen::Index>(light)) += value[static_cast<int>(c)] / sizes[r];
            }
        }
        for (std::size_t n = 0; n < of_unseen.size(); ++n) of_unseen[n].push_back(found.by_way_of_unseen[n]);
    }
    const auto count = static_cast<double>(parts);
    for (std::size_t j = 0; j < lights; ++j)
        result.pictures.push_back(pictures.estimate(j * pixels, projector.width(), projector.height(), count));
    result.direct = direct.estimate(0, projector.width(), projector.height(), count);
    for (const std::vector<double>& of_bounce : of_unseen) result.by_way_of_unseen.push_back(mean_of(of_bounce));
}

}  // namespace

Estimate LightRenders::direct_of(std::size_t light) const {
    const Image black(direct.mean.width, direct.mean.height);
    Estimate result = direct;
    result.mean = result.standard_error = black;
    for (std::size_t p = 0; p < direct.mean.pixels.size(); ++p) {
        if (parts.regions.of_pixel[p] != static_cast<int>(light)) continue;
        result.mean.pixels[p] = direct.mean.pixels[p];
        result.standard_error.pixels[p] = direct.standard_error.pixels[p];
    }
    return result;
}

LightRenders render_lights(const ProjectorLights& projector, const LightSampling& sampling, const Watch& watch,
                           const std::function<void(double)>& tell) {
    const Stopwatch clock;
    const Scene flooded = projector.flooded();
    LightRenders result;
    render_pictures(projector, flooded, sampling, watch, tell, result);
    tell(1.0);
    Goal goal = ProjectorLights::goal_of(1, more_samples_forward * sampling.samples, sampling.seed);
    goal.bounces = sampling.bounces;
    Watch silent;
    silent.stop = watch.stop;
    silent.checkpoints = false;
    const BounceSeries series = render(flooded, method::Walk(), goal, silent);
    if (watch.stop()) throw Stopped();
    for (const auto& [text, count] : series.warnings.counts()) result.warnings.add(text, count);
    for (int n = 1; n <= sampling.bounces; ++n) result.forward.push_back(series.term(static_cast<std::size_t>(n)));
    result.seconds = clock.seconds();
    return result;
}

}  // namespace neumann
