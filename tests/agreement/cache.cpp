#include "operators/render/methods/method_options.h"
#include "tests/agreement/reference.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace neumann::agreement::cache_test {

using physics::Blocks;

// Within t SE + bias, as a render states it, in 95% of all blocks, bounces and channels, and in 85% of those of a scene. Blocks
// that the reference does not know to 2% are left out. Values of a scene go together (all blocks of a pass read the same records),
// so that 150 of them are about as many as 50: 85% leaves 3 standard deviations of their number. Passed over four seeds.
TEST(CachePicturesSlow, AreWithinTheirStatedErrors) {
    struct Case {
        const char *scene, *records;
    };
    Count all;
    for (const Case& c : {Case{"cornell-box", "hessian"}, Case{"cornell-box", "split-sphere"}, Case{"door-ajar", "hessian"},
                          Case{"metal-room", "hessian"}, Case{"outdoor", "hessian"}, Case{"floating-panels", "split-sphere"}}) {
        const Reference& exact = reference(c.scene);
        const Blocks cache(
            exact.scene,
            physics::settings_of(exact.scene, make_method({"cache", {{"records", c.records}, {"directions", "128"}}}), bounces,
                                 physics::fixed_seed + 1, 0.5),
            block, 24);
        const Count count = compare(
            cache, exact, {.what = fmt::format("cache, {},", c.records), .known = 0.02, .bias = [&](auto b, auto q, auto channel) {
                               return cache.stated_bias(b, q, channel);
                           }});
        EXPECT_GE(count.within, 0.85 * count.all) << c.scene << ", " << c.records;
        all += count;
    }
    std::printf("%d of %d within\n", all.within, all.all);
    EXPECT_GE(all.within, 0.95 * all.all);
}

}  // namespace neumann::agreement::cache_test
