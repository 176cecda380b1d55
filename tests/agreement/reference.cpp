#include "tests/agreement/reference.h"

#include "core/reader/read_scene.h"
#include "operators/render/methods/method_options.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace neumann::agreement {

namespace {

struct Maker {
    const char* method;
    std::uint64_t replicates;  // of 16 samples
    bool knows_rest;
    std::uint64_t of_both_ends = 0;  // replicates for the pixels, where they are others
};
const std::map<std::string, Maker> makers = {
    {"cornell-box", {"walk", 256, true}},      {"door-ajar", {"bidirectional", 256, true}},
    {"furnace", {"walk", 64, true}},           {"mitsuba-cornell", {"walk", 256, true}},
    {"sphere-segment", {"walk", 256, true}},   {"facing-mirrors", {"walk", 128, true, 256}},
    {"floating-panels", {"walk", 128, true}},  {"glass-ball", {"bidirectional", 512, false}},
    {"glossy-floor", {"walk", 128, true}},     {"metal-room", {"bidirectional", 256, true}},
    {"outdoor", {"bidirectional", 256, true}},
};

Reference make(const std::string& name) {
    const Maker& maker = makers.at(name);
    Scene scene = read_scene(fmt::format(SCENES "/{}/{}.xml", name, name), {{"res", "32"}});
    const auto by = [&](const char* method, std::uint64_t replicates, SeriesMoments* pixels) {
        const SamplingSettings settings =
            physics::settings_of(scene, make_method({method, {}}), static_cast<int>(bounces), physics::fixed_seed, 0.5);
        return physics::Blocks(scene, settings, block, replicates, pixels);
    };
    SeriesMoments pixels(32, 32, bounces + 2);  // with the rest
    physics::Blocks blocks = by(maker.method, maker.replicates, maker.of_both_ends > 0 ? nullptr : &pixels);
    if (maker.of_both_ends > 0) by("bidirectional", maker.of_both_ends, &pixels);
    return {name, std::move(scene), maker.knows_rest, std::move(blocks), pixels.result()};
}

}  // namespace

const Reference& reference(const std::string& scene) {
    static std::map<std::string, Reference> made;
    const auto there = made.find(scene);
    return there != made.end() ? there->second : made.emplace(scene, make(scene)).first->second;
}

Count compare(const physics::Blocks& found, const Reference& reference, const Comparison& comparison) {
    Count count;
    double largest = 0.0;
    std::optional<physics::Blocks> more;
    const std::uint64_t n = found.replicates(), m = reference.blocks.replicates();
    const double t = student_t_quantile(0.95, static_cast<double>(n) - 1.0);
    for (std::size_t q = 0; q <= bounces + (reference.knows_rest ? 1 : 0); ++q)
        for (std::size_t channel = 0; channel < 3; ++channel) {
            for (std::size_t b = 0; b < found.blocks(); ++b) {
                auto f = found.at(b, q, channel, n);
                const auto r = reference.blocks.at(b, q, channel, m);
                if (r.mean == 0.0 || r.error > comparison.known * r.mean) continue;
                const double stated = comparison.bias ? comparison.bias(b, q, channel) : 0.0;
                double error = std::hypot(f.error, r.error), off = std::abs(f.mean - r.mean);
                if (error == 0.0) {
                    EXPECT_NEAR(f.mean, r.mean, 2.0 * stated + 1e-9 * r.mean);
                    continue;
                }
                count += {off <= t * error + stated, 1};
                if (off > 4.5 * error + 2.0 * stated && comparison.once_more) {
                    if (!more) more = comparison.once_more();
                    std::printf("%s in %s, bounce %zu, block %zu, channel %zu: %.2f SE off, looked at again\n",
                                comparison.what.c_str(), reference.name.c_str(), q, b, channel, off / error);
                    f = more->at(b, q, channel, more->replicates());
                    error = std::hypot(f.error, r.error), off = std::abs(f.mean - r.mean);
                }
                largest = std::max(largest, off / error);
                EXPECT_LE(off, 4.5 * error + 2.0 * stated)
                    << comparison.what << " in " << reference.name << ", bounce " << q << ", block " << b << ", channel " << channel
                    << ": " << f.mean << " ± " << f.error << " and bias " << stated << ", " << r.mean << " ± " << r.error;
            }
        }
    std::printf("%s in %s: %d of %d within, at most %.2f SE off\n", comparison.what.c_str(), reference.name.c_str(), count.within,
                count.all, largest);
    EXPECT_GE(count.all, 30) << comparison.what << " in " << reference.name;
    return count;
}

}  // namespace neumann::agreement
