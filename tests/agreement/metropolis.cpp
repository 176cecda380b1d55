#include "operators/methods/method_options.h"
#include "tests/agreement/reference.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace neumann::agreement::metropolis_test {

using physics::Blocks;

// 95% of intervals hold the other method's mean: with this seed 1135 of 1217 do. Values of a scene go together, for all blocks of a
// replicate share the brightness of a bounce and channels their paths, so that 170 of them are about as many as 25: 80% leaves 3
// standard deviations of their number, and 91% of all leaves 2.5 of some 160. With references of a quarter of the samples five
// other seeds had |z| up to 4.51. With these one of three had 5.7, in a block of door-ajar that is nearly dark: few of the
// replicates have a state there, and their spread does not tell the error.
TEST(MetropolisPicturesSlow, AgreeWithOtherMethodsBounceByBounce) {
    Count all;
    for (const char* name : {"cornell-box", "glass-ball", "door-ajar", "glossy-floor", "metal-room", "facing-mirrors", "outdoor"}) {
        const Reference& exact = reference(name);
        const Blocks chains(
            exact.scene, physics::settings_of(exact.scene, method::Metropolis{}, bounces, physics::fixed_seed + 1, 0.5), block, 48);
        const Count count = compare(chains, exact, 0.05, "metropolis");
        EXPECT_GE(count.within, 0.8 * count.all) << name;
        all += count;
    }
    std::printf("%d of %d within\n", all.within, all.all);
    EXPECT_GE(all.within, 0.91 * all.all);
}

}  // namespace neumann::agreement::metropolis_test
