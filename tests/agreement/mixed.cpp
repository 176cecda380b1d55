#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/methods/method_options.h"
#include "tests/agreement/reference.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace neumann::agreement::mixed_test {

using physics::Blocks;

// As a pilot mixes them: 92% within their 95% intervals, scene by scene 85% (channels go together: 170 values are about as many as
// 60, of which three standard deviations are 9%). Passed over eight seeds, four of them with the last three scenes: 93 to 96%. Rare
// paths of walks made up to three values a seed be looked at again: in outdoor and metal-room (4.7 to 6.1 SE, then at most 4.3),
// and in glass-ball (19 SE, then 3.3), where the pilot had given caustics to `guided`. In sphere-segment `corrected` has all of it,
// whose replicates share their points among all blocks: of 240 values 192 were within, 80%, and at most 3.2 SE off.
TEST(MixedPicturesSlow, AgreeWithOtherMethodsBounceByBounce) {
    Count all;
    for (const char* name : {"cornell-box", "door-ajar", "glossy-floor", "metal-room", "facing-mirrors", "outdoor", "glass-ball",
                             "furnace", "mitsuba-cornell", "floating-panels"}) {
        const Reference& exact = reference(name);
        const auto settings = [&](std::uint64_t seed) {
            return physics::settings_of(exact.scene, method::Mixed{}, bounces, physics::fixed_seed + seed, 0.5);
        };
        const SamplingSettings mixed = settings(1);
        const auto* paths = as<MixedPaths>(mixed.method);
        ASSERT_TRUE(paths);
        std::string parts;
        for (const Mixture::Part& part : paths->mixture().parts)
            parts += fmt::format(" {} {:.0f}%", part.method, 100.0 * part.share);
        const Count count = compare(Blocks(exact.scene, mixed, block, 64), exact,
                                    {.what = fmt::format("mixed,{},", parts), .known = 0.05, .once_more = [&] {
                                         return Blocks(exact.scene, settings(2), block, 256);
                                     }});
        EXPECT_GE(count.within, 0.85 * count.all) << name;
        all += count;
    }
    std::printf("%d of %d within\n", all.within, all.all);
    EXPECT_GE(all.within, 0.92 * all.all);
}

}  // namespace neumann::agreement::mixed_test
