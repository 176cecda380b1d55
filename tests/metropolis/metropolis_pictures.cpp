// Pictures by chains beside those of walks and closed forms, bounce by bounce, and what chains share with the independent paths
// from which they start.
#include "core/reader/read_scene.h"
#include "operators/paths/metropolis/chain_batch.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/sampling.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace neumann::metropolis_pictures_test {

using physics::Blocks;
using physics::fixed_seed;

Scene scene_of(const std::string& name, int resolution, std::vector<std::pair<std::string, std::string>> more = {}) {
    more.emplace_back("res", std::to_string(resolution));
    return read_scene(fmt::format(SCENES "/{}/{}.xml", name, name), {more.begin(), more.end()});
}

SamplingSettings settings_of(const Scene& scene, const Method& method, int bounces, std::uint64_t seed, std::uint32_t size,
                             double rest = 0.0) {
    SamplingSettings settings = sampling_settings(method, scene, {}, seed);
    settings.walk.bounces = bounces;
    settings.walk.rest_probability = rest;
    settings.replicate_size = size;
    Prepared prepared(seed);
    set_up(method, scene, bounces, 1e9, settings, prepared);
    return settings;
}

// Each way by itself is what it is among all ways, to the bit: the state from which a chain starts has the f of its path.
TEST(ChainBatch, StartsWithTheLightOfItsPath) {
    for (const char* name : {"glass-ball", "cornell-box", "outdoor"}) {
        const Scene scene = scene_of(name, 32);
        constexpr int bounces = 5;
        const WalkSettings walk{.bounces = bounces, .rest_probability = 0.0};
        const IndependentPaths paths(scene, walk, SamplerKind::sobol, fixed_seed, 4096);
        const Bidirectional bidirectional(scene, walk, paths.area().pixels());
        IndependentPaths::Workspace work;
        std::vector<std::uint64_t> rays(bounces + 2);
        int compared = 0;
        for (std::uint32_t group = 0; group < paths.groups(); group += 7) {
            std::map<int, std::vector<std::pair<ChainStart, double>>> of_bounce;
            (void)paths.trace_group(
                3, group, work,
                [&](std::uint32_t i, const WayFound& found) {
                    of_bounce[found.bounce].push_back({{group * chains_at_once + i, found.s}, size_of(found.value)});
                },
                std::span(rays));
            for (const auto& [bounce, found] : of_bounce) {
                if (bounce == 0) continue;
                std::vector<ChainStart> starts;
                std::vector<Sampler> random;
                for (std::size_t k = 0; k < found.size() && k < chains_at_once; ++k) {
                    starts.push_back(found[k].first);
                    random.emplace_back(fixed_seed, 0);
                }
                ChainBatch chains(scene, bidirectional, paths.area(), bounce);
                chains.start(paths, 3, starts, random, std::span(rays));
                for (std::uint32_t k = 0; k < starts.size(); ++k, ++compared)
                    EXPECT_EQ(chains.size(k), found[k].second) << name << ", bounce " << bounce << ", way s = " << starts[k].s;
            }
        }
        EXPECT_GE(compared, 500) << name;
    }
}

// The states that a chain leaves have shares that add up to its steps.
TEST(ChainBatch, SharesOutAllOfItsSteps) {
    const Scene scene = scene_of("cornell-box", 16);
    const WalkSettings walk{.bounces = 3, .rest_probability = 0.0};
    const IndependentPaths paths(scene, walk, SamplerKind::independent, fixed_seed, 64);
    const Bidirectional bidirectional(scene, walk, paths.area().pixels());
    IndependentPaths::Workspace work;
    std::vector<std::uint64_t> rays(5);
    std::vector<ChainStart> starts;
    (void)paths.trace_group(
        0, 0, work,
        [&](std::uint32_t i, const WayFound& found) {
            if (found.bounce == 2) starts.push_back({i, found.s});
        },
        std::span(rays));
    std::vector<Sampler> random;
    for (std::uint32_t i = 0; i < starts.size(); ++i) random.emplace_back(fixed_seed, i);
    ASSERT_GE(starts.size(), 10u);
    ChainBatch chains(scene, bidirectional, paths.area(), 2);
    double share = 0.0;
    const auto left = [&](const LeftState& state) { share += size_of(state.value); };
    chains.start(paths, 0, starts, random, std::span(rays));
    constexpr std::uint32_t steps = 200;
    for (std::uint32_t t = 1; t < steps; ++t) chains.step(t, left, std::span(rays));
    ChainStatistics statistics;
    chains.end(left, statistics);
    EXPECT_NEAR(share, steps * static_cast<double>(starts.size()), 1e-7 * share);
    EXPECT_EQ(statistics.states, steps * starts.size());
    EXPECT_EQ(statistics.small + statistics.large, (steps - 1) * starts.size());
    EXPECT_GT(statistics.small_accepted, 0u);
    EXPECT_GT(statistics.large_accepted, 0u);
    // A share of 0.3, to 4 σ.
    const auto n = static_cast<double>(statistics.small + statistics.large);
    EXPECT_NEAR(static_cast<double>(statistics.large), 0.3 * n, 4.0 * std::sqrt(0.21 * n));
}

// Inside a sphere of radiance 1 and albedo ρ = 0.9, 0.7, 0.5 each bounce is ρ^i in every pixel. Replicates are unbiased, however
// short the chains: 64 chains of 16 states, mostly near their starts. 1536 means, |z| ≤ 4.5 by Student's t of 127 degrees of
// freedom (beyond which are 1.6e-5 of all, channels going together: false alarm below 2.5%; fixed seed passed over twelve others).
TEST(MetropolisPictures, HaveTheClosedFormOfAFurnace) {
    const Scene scene = read_scene(SCENES "/furnace/furnace.xml", {{"res", "8"}});
    const SamplingSettings walk = settings_of(scene, method::Walk{}, 4, fixed_seed, 16),
                           chains = settings_of(scene, method::Metropolis{}, 4, fixed_seed, 16);
    const Blocks exact(scene, walk, 4, 64), found(scene, chains, 4, 128);
    for (std::size_t q = 0; q <= 4; ++q)
        for (std::size_t b = 0; b < found.blocks(); ++b)
            for (std::size_t c = 0; c < 3; ++c) {
                const auto m = found.at(b, q, c, 128), w = exact.at(b, q, c, 64);
                EXPECT_LE(std::abs(m.mean - w.mean), 4.5 * std::hypot(m.error, w.error) + 1e-12 * w.mean)
                    << q << ", block " << b << ": " << m.mean << " ± " << m.error << ", " << w.mean << " ± " << w.error;
            }
}

}  // namespace neumann::metropolis_pictures_test
