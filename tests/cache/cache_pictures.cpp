// Pictures by an irradiance cache beside those of walks, bounce by bounce: they differ by no more than their standard errors and
// their estimated bias say.
#include "core/reader/read_scene.h"
#include "operators/cache/record_places.h"
#include "operators/methods/method_options.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace neumann::cache_pictures_test {

using physics::Blocks;
using physics::fixed_seed;
using physics::settings_of;

struct Case {
    const char* scene;
    const char* reference;  // a method that makes all its paths well
    std::uint64_t replicates;
    bool rest;  // whether the reference knows the rest, which walks from the camera measure
};

// |cache − reference| ≤ t SE + bias in 95% of all blocks, bounces and channels, and in 90% of those of a scene; and nowhere farther
// off than 4.5 SE + 2 bias. Blocks that the reference does not know to 2% are left out. Values of a scene go together (all blocks
// of a pass read the same records), so that 150 of them are about as many as 50: 90% leaves 1.6 standard deviations of their
// number, with intervals that are wider than 95% by the bias.
TEST(CachePicturesSlow, AreWithinTheirStatedErrors) {
    int within_all = 0, all = 0;
    for (const Case& c : {Case{"cornell-box", "walk", 64, true}, Case{"door-ajar", "bidirectional", 256, true},
                          Case{"glossy-floor", "walk", 128, true}, Case{"metal-room", "bidirectional", 256, true},
                          Case{"outdoor", "bidirectional", 256, true}, Case{"facing-mirrors", "walk", 128, true},
                          Case{"floating-panels", "walk", 128, true}, Case{"sphere-segment", "walk", 64, true}}) {
        const Scene scene = read_scene(fmt::format(SCENES "/{}/{}.xml", c.scene, c.scene), {{"res", "32"}});
        constexpr std::size_t bounces = 4;
        const Blocks reference(scene, settings_of(scene, make_method({c.reference, {}}), bounces, fixed_seed, 0.5), 8,
                               c.replicates);
        for (const char* records : {"hessian", "split-sphere"}) {
            const SamplingSettings settings = settings_of(
                scene, make_method({"cache", {{"records", records}, {"directions", "64"}}}), bounces, fixed_seed + 1, 0.5);
            const Blocks cache(scene, settings, 8, 128, wider - 1.0);
            int within = 0, count = 0;
            for (std::size_t q = 0; q <= bounces + (c.rest ? 1 : 0); ++q)
                for (std::size_t b = 0; b < cache.blocks(); ++b)
                    for (std::size_t channel = 0; channel < 3; ++channel) {
                        const auto p = cache.at(b, q, channel, cache.replicates()), r = reference.at(b, q, channel, c.replicates);
                        if (r.mean == 0.0 || r.error > 0.02 * r.mean) continue;
                        const double error = std::hypot(p.error, r.error), off = std::abs(p.mean - r.mean);
                        within += off <= student_t_quantile(0.95, 127.0) * error + p.bias;
                        EXPECT_LE(off, 4.5 * error + 2.0 * p.bias)
                            << c.scene << ", " << records << ", bounce " << q << ", block " << b << ", channel " << channel << ": "
                            << p.mean << " ± " << p.error << " and bias " << p.bias << ", " << r.mean << " ± " << r.error;
                        ++count;
                    }
            std::printf("%s, %s: %zu records, %d of %d within\n", c.scene, records, settings.records->records().size(), within,
                        count);
            EXPECT_GE(within, 0.9 * count) << c.scene << ", " << records;
            EXPECT_GE(count, 30) << c.scene;
            within_all += within;
            all += count;
        }
    }
    std::printf("%d of %d within\n", within_all, all);
    EXPECT_GE(within_all, 0.95 * all);
}

}  // namespace neumann::cache_pictures_test
