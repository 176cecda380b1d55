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
    const char* records;
    std::uint64_t replicates;
    bool rest;  // whether the reference knows the rest, which walks from the camera measure
};

// |cache − reference| ≤ t SE + bias, as a render states it, in 95% of all blocks, bounces and channels, and in 85% of those of a
// scene; and nowhere farther off than 4.5 SE + 2 bias. Blocks that the reference does not know to 2% are left out. Values of a
// scene go together (all blocks of a pass read the same records), so that 150 of them are about as many as 50: 85% leaves 3
// standard deviations of their number. Passed over four seeds.
TEST(CachePicturesSlow, AreWithinTheirStatedErrors) {
    constexpr std::size_t bounces = 4;
    int within_all = 0, all = 0;
    for (const Case& c :
         {Case{"cornell-box", "walk", "hessian", 32, true}, Case{"cornell-box", "walk", "split-sphere", 32, true},
          Case{"door-ajar", "bidirectional", "hessian", 64, true}, Case{"metal-room", "bidirectional", "hessian", 128, true},
          Case{"outdoor", "bidirectional", "hessian", 128, true}, Case{"floating-panels", "walk", "split-sphere", 64, true}}) {
        const Scene scene = read_scene(fmt::format(SCENES "/{}/{}.xml", c.scene, c.scene), {{"res", "32"}});
        const Blocks reference(scene, settings_of(scene, make_method({c.reference, {}}), bounces, fixed_seed, 0.5), 8,
                               c.replicates);
        const SamplingSettings settings = settings_of(
            scene, make_method({"cache", {{"records", c.records}, {"directions", "128"}}}), bounces, fixed_seed + 1, 0.5);
        constexpr std::uint64_t passes = 24;
        const Blocks cache(scene, settings, 8, passes);
        int within = 0, count = 0;
        for (std::size_t q = 0; q <= bounces + (c.rest ? 1 : 0); ++q)
            for (std::size_t channel = 0; channel < 3; ++channel)
                for (std::size_t b = 0; b < cache.blocks(); ++b) {
                    const auto p = cache.at(b, q, channel, passes), r = reference.at(b, q, channel, c.replicates);
                    if (r.mean == 0.0 || r.error > 0.02 * r.mean) continue;
                    const double error = std::hypot(p.error, r.error), off = std::abs(p.mean - r.mean),
                                 bias = cache.stated_bias(b, q, channel);
                    within += off <= student_t_quantile(0.95, passes - 1.0) * error + bias;
                    EXPECT_LE(off, 4.5 * error + 2.0 * bias)
                        << c.scene << ", " << c.records << ", bounce " << q << ", block " << b << ", channel " << channel << ": "
                        << p.mean << " ± " << p.error << " and bias " << bias << ", " << r.mean << " ± " << r.error;
                    ++count;
                }
        std::printf("%s, %s: %zu records, %d of %d within\n", c.scene, c.records, settings.records->records().size(), within,
                    count);
        EXPECT_GE(within, 0.85 * count) << c.scene << ", " << c.records;
        EXPECT_GE(count, 30) << c.scene;
        within_all += within;
        all += count;
    }
    std::printf("%d of %d within\n", within_all, all);
    EXPECT_GE(within_all, 0.95 * all);
}

}  // namespace neumann::cache_pictures_test
