// One table: the ways to make all paths in the scenes that are there to compare methods, bounce by bounce, beside the reference of
// the scene. A third of its cells is of a day, in which a method that has all scenes has a third of them, and every scene a third
// of its methods; nightly has all.
#include "operators/render/from_paths/walk_paths.h"
#include "operators/render/methods/method_options.h"
#include "operators/statistics/student_t.h"
#include "tests/agreement/reference.h"
#include "tests/physics/seed.h"
#include "tests/physics/today.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

namespace neumann::agreement::table_test {

using physics::Blocks;

// What is stated of the bias of the mean of a block.
enum class Bias { none, of_means, of_pixels };

// Values of a scene go together: its channels have the same paths, and all blocks of a replicate what the replicate shares. So n of
// them are about as many as n/3, or fewer, and the part of a scene that has to be within the 95% intervals leaves them three
// standard deviations of their number.
struct Limits {
    double known;               // values are left out that the reference does not know to this part
    double of_a_scene, of_all;  // the least parts within their intervals; of_all where a process has all scenes (nightly)
};
constexpr Limits usual{0.05, 0.85, 0.9}, thinned{0.05, 0.85, 0.85}, of_mixtures{0.05, 0.85, 0.92}, of_chains{0.05, 0.8, 0.91},
    of_photons{0.02, 0.9, 0.95}, of_records{0.02, 0.85, 0.95};

struct Row {
    std::string name;
    std::function<SamplingSettings(const Scene&, std::uint64_t seed)> settings;
    std::uint64_t replicates;
    Limits limits;
    std::vector<std::string> scenes;
    Bias bias = Bias::none;
    // Where rare paths bring light, few replicates of some methods do not tell the spread of all values: so many may be further off
    // than 4.5 standard errors (at most one was, in three seeds of four scenes). What is wrong in a block is so in three channels.
    std::size_t far = 0;
};

bool has_rare_paths(const std::string& scene) {
    return scene == "door-ajar" || scene == "glass-ball" || scene == "metal-room" || scene == "outdoor";
}
// The largest error that the mean of a bounce over the picture may have, as a part of it: a table without power sees nothing. What
// goes to and fro between mirrors, and what glass gathers, has few paths; few of a sky's photons come where the camera looks; and
// few thinned walks are left.
double largest_error(const std::string& method, const std::string& scene) {
    static const std::map<std::string, double> of_scenes{
        {"cornell-box", 0.025}, {"door-ajar", 0.025},       {"facing-mirrors", 0.1}, {"floating-panels", 0.05},
        {"furnace", 0.01},      {"glass-ball", 0.1},        {"glossy-floor", 0.08},  {"metal-room", 0.04},
        {"outdoor", 0.05},      {"mitsuba-cornell", 0.025}, {"sphere-segment", 0.01}};
    if (scene == "outdoor" && method.starts_with("photon")) return 0.2;
    return of_scenes.at(scene) * (method == "walk_thinned" ? 2.0 : 1.0);
}

using Options = std::vector<std::pair<std::string, std::string>>;
auto by(const std::string& method, const Options& options = {}, std::uint32_t size = 0) {
    return [=](const Scene& scene, std::uint64_t seed) {
        SamplingSettings settings = physics::settings_of(scene, make_method({method, options}), bounces, seed, 0.5);
        if (size > 0) settings.replicate_size = size;
        return settings;
    };
}
// Where a surface is met at a short distance the weights of its points have no variance, which the rest gathers from all of them.
auto without_rest(const std::string& method) {
    return [=](const Scene& scene, std::uint64_t seed) {
        SamplingSettings settings = by(method)(scene, seed);
        settings.walk.rest_probability = 0.0;
        return settings;
    };
}
// Without the light that directions hit.
auto by_lights(const std::function<SamplingSettings(const Scene&, std::uint64_t)>& with_mis) {
    return [=](const Scene& scene, std::uint64_t seed) {
        SamplingSettings settings = with_mis(scene, seed);
        settings.walk.direct.direct = DirectLight::light;
        return settings;
    };
}
auto by_trees(const std::vector<double>& ratios) {
    return [=](const Scene& scene, std::uint64_t seed) {
        SamplingSettings settings = by("walk")(scene, seed);
        settings.method = std::make_shared<const WalkPaths>(std::make_shared<const TreeRatios>(TreeRatios{ratios}));
        return settings;
    };
}

std::vector<Row> rows() {
    const std::vector<std::string> all = scenes_with_reference(),
                                   of_walks{"cornell-box",  "facing-mirrors",  "floating-panels", "furnace",
                                            "glossy-floor", "mitsuba-cornell", "sphere-segment"};
    const auto without = [&](std::vector<std::string> left_out) {
        std::vector<std::string> scenes = all;
        std::erase_if(scenes, [&](const std::string& s) { return std::ranges::find(left_out, s) != left_out.end(); });
        return scenes;
    };
    const Options guide{{"patches", "500"}, {"directions", "256"}};
    return {
        {"bidirectional", by("bidirectional"), 64, usual, of_walks},
        {"light", by("light"), 64, usual, {"cornell-box", "door-ajar", "floating-panels", "furnace"}},
        {"surface", without_rest("surface"), 64, usual, {"floating-panels"}},
        {"shooting", without_rest("shooting"), 64, usual, {"floating-panels"}},
        {"walk", by("walk"), 256, usual, {"door-ajar", "metal-room", "outdoor"}},
        {"walk_uniform", by("walk", {{"indirect", "uniform"}}), 256, usual, {"cornell-box", "glossy-floor"}},
        {"walk_cosine", by("walk", {{"indirect", "cosine"}}), 256, usual, {"metal-room", "outdoor"}},
        {"walk_in_trees", by_trees({0.3, 3.4, 0.5, 1.6}), 64, usual, {"cornell-box", "floating-panels"}},
        {"walk_split", by_trees({7.0}), 32, usual, {"cornell-box", "floating-panels"}},
        {"walk_thinned", by_trees({0.2, 0.6, 0.6, 0.6}), 128, thinned, {"cornell-box", "floating-panels"}},
        {"walk_reused", by("walk", {{"reuse", "true"}}), 64, usual, without({"glass-ball", "metal-room", "sphere-segment"})},
        {"walk_reused_with_roulette", by("walk", {{"reuse", "true"}, {"roulette", "0.7"}}), 64, usual, {"cornell-box"}},
        {"guided", by("guided", guide), 64, usual, without({"glass-ball", "metal-room"})},
        {"guided_among_metals", by("guided", guide), 256, usual, {"metal-room"}},
        {"guided_to_lights", by_lights(by("guided", guide)), 64, usual, {"cornell-box"}},
        {"guided_to_lights_among_metals", by_lights(by("guided", guide)), 256, usual, {"metal-room"}},
        {"corrected", by("corrected", {{"patches", "300"}, {"directions", "32"}}, 8), 64, usual, without({"glass-ball"})},
        {"photon", by("photon", {{"gather", "false"}, {"photons", "16384"}}), 128, of_photons, all, Bias::of_means},
        {"photon_gathered", by("photon", {{"gather", "true"}, {"photons", "16384"}}), 128, of_photons,
         without({"furnace", "mitsuba-cornell", "floating-panels", "sphere-segment"}), Bias::of_means},
        {"cache_by_hessians",
         by("cache", {{"records", "hessian"}, {"directions", "128"}}),
         24,
         of_records,
         {"cornell-box", "door-ajar", "metal-room", "outdoor"},
         Bias::of_pixels},
        {"cache_by_split_spheres",
         by("cache", {{"records", "split-sphere"}, {"directions", "128"}}),
         24,
         of_records,
         {"cornell-box", "floating-panels"},
         Bias::of_pixels},
        {"mixed", by("mixed"), 64, of_mixtures, without({"sphere-segment"}), Bias::none, 2},
        {"metropolis", by("metropolis"), 48, of_chains, all, Bias::none, 2},
    };
}

struct Cell {
    Row row;
    std::string scene;
    std::size_t number;  // of the row and the scene, which share out the table among days
    friend void PrintTo(const Cell& cell, std::ostream* out) { *out << cell.row.name << " in " << cell.scene; }
};
std::vector<Cell> cells() {
    std::vector<Cell> cells;
    const std::vector<std::string> scenes = scenes_with_reference();
    std::size_t number = 0;
    for (const Row& row : rows()) {
        for (const std::string& scene : row.scenes)
            cells.push_back({row, scene, number + static_cast<std::size_t>(std::ranges::find(scenes, scene) - scenes.begin())});
        ++number;
    }
    return cells;
}

struct Count {
    int within = 0, all = 0, cells = 0;
};
std::map<std::string, Count> counts;  // of rows

class TableSlow : public testing::TestWithParam<Cell> {
public:
    static void TearDownTestSuite() {
        for (const Row& row : rows()) {
            const Count& count = counts[row.name];
            if (row.scenes.size() == 1 || count.cells < static_cast<int>(row.scenes.size())) continue;
            std::printf("%s: %d of %d within\n", row.name.c_str(), count.within, count.all);
            EXPECT_GE(count.within, row.limits.of_all * count.all) << row.name;
        }
    }
};

// All terms of all blocks and of the picture, in each channel, and the rest if the reference knows it. Where both are exact they
// are the same; elsewhere |found − reference| ≤ 4.5 SE + 2 bias, but for values of paths that are so rare that few replicates do
// not tell their spread, and it is counted how many are within t SE + bias, 95% of them in the long run.
TEST_P(TableSlow, AgreesWithTheReference) {
    const auto& [row, name, number] = GetParam();
    if (!physics::is_of_today(number)) GTEST_SKIP() << "of another day";
    const Reference& exact = reference(name);
    const SamplingSettings settings = row.settings(exact.scene, physics::fixed_seed + 1);
    ASSERT_EQ(settings.method->paths(exact.scene), Paths::all) << "not all paths are made";
    const Blocks found(exact.scene, settings, block, row.replicates);
    const double t = student_t_quantile(0.95, static_cast<double>(row.replicates) - 1.0);
    Count count{.cells = 1};
    std::size_t far = 0;
    double largest = 0.0, worst = 0.0;
    int pictures = 0;
    for (std::size_t q = 0; q <= bounces + (exact.knows_rest && settings.walk.rest_probability > 0.0 ? 1 : 0); ++q)
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t b = 0; b <= blocks; ++b) {
                const Blocks::Value f = found.at(b, q, channel, row.replicates), &r = exact.at(b, q, channel);
                const double error = std::hypot(f.error, r.error), off = std::abs(f.mean - r.mean);
                if (r.mean == 0.0 || r.error > row.limits.known * r.mean) continue;
                if (b == blocks) {
                    worst = std::max(worst, error / r.mean);
                    ++pictures;
                }
                ASSERT_TRUE(std::isfinite(f.mean) && std::isfinite(f.error));
                const double bias = row.bias == Bias::none       ? 0.0
                                    : row.bias == Bias::of_means ? f.bias
                                                                 : found.stated_bias(b, q, channel);
                if (error == 0.0) {
                    EXPECT_NEAR(f.mean, r.mean, 2.0 * bias + 1e-9 * r.mean);
                    continue;
                }
                count.within += off <= t * error + bias ? 1 : 0;
                ++count.all;
                largest = std::max(largest, off / error);
                if (!(off <= 4.5 * error + 2.0 * bias) && ++far > (has_rare_paths(name) ? row.far : 0))
                    ADD_FAILURE() << "bounce " << q << ", block " << b << ", channel " << channel << ": " << f.mean << " ± "
                                  << f.error << " and bias " << bias << ", " << r.mean << " ± " << r.error;
            }
    std::printf("%d of %d within, at most %.2f SE off, %zu too far; largest error of a mean %.2f%%\n", count.within, count.all,
                largest, far, 100.0 * worst);
    EXPECT_GE(count.all, 50);
    EXPECT_GE(pictures, 9) << "channels of the picture's means, of three bounces at least";
    EXPECT_GE(count.within, row.limits.of_a_scene * count.all);
    EXPECT_LE(worst, largest_error(row.name, name));
    Count& of_row = counts[row.name];
    of_row.within += count.within, of_row.all += count.all, ++of_row.cells;
}

INSTANTIATE_TEST_SUITE_P(Methods, TableSlow, testing::ValuesIn(cells()), [](const auto& cell) {
    std::string name = cell.param.row.name + "_in_" + cell.param.scene;
    std::ranges::replace(name, '-', '_');
    return name;
});

}  // namespace neumann::agreement::table_test
