// Pictures of mixtures beside those of single methods, bounce by bounce.
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/metropolis_sampler.h"
#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/from_paths/mixture.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/report/replay.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace neumann::mixed_pictures_test {

using physics::Blocks;
using physics::fixed_seed;

Scene scene_of(const std::string& name, int resolution) {
    return read_scene(fmt::format(SCENES "/{}/{}.xml", name, name), {{"res", std::to_string(resolution)}});
}

constexpr std::size_t parts = 5;

// Five methods, with weights and numbers of samples that nothing asks for: some blocks and bounces miss a method, some pixels have
// no samples of one, if they can have samples of their own.
Mixture patchwork(const SamplingSettings& guided, std::uint32_t pixels, std::uint32_t width, std::size_t bounces) {
    Mixture mixture;
    mixture.blocks = {3, 2};
    mixture.bounces = bounces + 1;
    const std::size_t B = mixture.blocks.count();
    std::vector<Allocation> numbers(3);
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        const std::size_t b = mixture.blocks.of(pixel, width, pixels / width);
        numbers[0].exponents.push_back(b == 1 ? Allocation::none : static_cast<std::int8_t>(b) - 2);
        numbers[1].exponents.push_back(b % 2 == 0 ? Allocation::none : 0);
        numbers[2].exponents.push_back(b == 4 ? Allocation::none : -1);
    }
    const std::shared_ptr<const PathMethod> methods[parts] = {
        plain_walks(), guided.method, std::make_shared<const BidirectionalPaths>(), std::make_shared<const LightPaths>(),
        std::make_shared<const MetropolisPaths>()};
    for (std::size_t m = 0; m < parts; ++m) {
        const bool has_even = methods[m]->has_even_samples();
        mixture.parts.push_back({fmt::format("method {}", m),
                                 methods[m],
                                 {},
                                 has_even ? nullptr : std::make_shared<const Allocation>(numbers[m]),
                                 static_cast<std::int8_t>(m == 3 ? -1 : 1),
                                 1.0 / parts});
    }
    mixture.weights.assign(parts * mixture.bounces * B, 0.0);
    for (std::size_t q = 0; q < mixture.bounces; ++q)
        for (std::size_t b = 0; b < B; ++b) {
            double first = 0.25 + 0.1 * static_cast<double>(q), second = 0.5 - first / 2.0;
            if (b == 1) first = 0.0;
            if (b % 2 == 0) second = 0.0;
            if (b == 4) first = 1.0;
            const double of_light = b == 3 ? 0.0 : 0.2, of_chains = 0.1 * static_cast<double>(q), left = 1.0 - of_light - of_chains;
            const double all[] = {left * first, left * second, left * (1.0 - first - second), of_light, of_chains};
            for (std::size_t m = 0; m < parts; ++m) mixture.weights[(m * mixture.bounces + q) * B + b] = all[m];
        }
    return mixture;
}

SamplingSettings patchwork_settings(const Scene& scene, int bounces, std::uint64_t seed, double rest) {
    SamplingSettings settings = physics::settings_of(scene, method::Guided{}, bounces, seed, rest);
    const auto width = static_cast<std::uint32_t>(scene.film.crop_width),
               height = static_cast<std::uint32_t>(scene.film.crop_height);
    settings.method = std::make_shared<const MixedPaths>(
        std::make_shared<const Mixture>(patchwork(settings, width * height, width, static_cast<std::size_t>(bounces))));
    return settings;
}

// Whatever the weights and numbers: |z| ≤ 4.5 in some 400 comparisons (false alarm 0.3%), 90% within their 95% intervals.
TEST(MixedPicturesSlow, HaveTheMeansOfWalksWhateverTheWeights) {
    const Scene scene = scene_of("cornell-box", 24);
    const Blocks walks(scene, physics::settings_of(scene, method::Walk{}, 3, fixed_seed, 0.5), 4, 64);
    const Blocks mixed(scene, patchwork_settings(scene, 3, fixed_seed + 1, 0.5), 4, 64);
    int within = 0, all = 0;
    for (std::size_t q = 0; q <= 4; ++q)
        for (std::size_t b = 0; b < walks.blocks(); ++b) {
            const auto x = walks.at(b, q, 1, 64), y = mixed.at(b, q, 1, 64);
            const double both = std::hypot(x.error, y.error);
            if (both == 0.0) continue;
            EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * both) << q << ", block " << b << ": " << x.mean << ", " << y.mean;
            within += std::abs(x.mean - y.mean) <= student_t_quantile(0.95, 120.0) * both;
            ++all;
        }
    EXPECT_GE(all, 140);
    EXPECT_GE(within, 0.90 * all) << within << " of " << all;
}

// The largest samples of the picture, and what their paths bring when they are traced again, to the bit.
TEST(MixedPictures, ReplayTheirSamples) {
    const Scene scene = scene_of("cornell-box", 12);
    const PictureSampler sampler(scene, patchwork_settings(scene, 2, 5, 0.0));
    Tally tally(sampler.quantities());
    (void)sampler.run(3, 1, tally).value();
    int compared = 0, from_lights = 0;
    for (std::size_t q = 1; q <= 2; ++q)
        for (const LargestSamples::Sample& s : tally.largest[q].standing_out()) {
            const Replay replayed = replay(sampler, s.place.name);
            if (s.place.name.pixel == s.place.pixel && max_component(glm::abs(replayed.terms[q])) == s.value) {
                ++compared;
                continue;
            }
            // Otherwise a path from a light brought it, there or to another pixel.
            double nearest = std::numeric_limits<double>::infinity();
            for (const ReplayedStep& step : replayed.steps)
                for (const ReplayedStep::Contribution& found : step.found)
                    if (found.pixel && found.quantity == q)
                        nearest = std::min(nearest, std::abs(max_component(found.value) / s.value - 1.0));
            ++from_lights;
            EXPECT_GE(s.place.name.sample % parts, 2u);
            EXPECT_LE(nearest, 1e-9) << s.value;
        }
    EXPECT_GT(compared, 50);
    EXPECT_GT(from_lights, 10);
}

}  // namespace neumann::mixed_pictures_test
