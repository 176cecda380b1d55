#include "operators/render/methods/method_options.h"
#include "tests/agreement/reference.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <utility>
#include <vector>

namespace neumann::agreement::photon_test {

using physics::Blocks;

// Within t SE + bias in 95% of all blocks, bounces and channels, and in 90% of those of a scene. Blocks that the reference does not
// know to 2% are left out. Values of a scene go together (the channels have the same photons, and neighbours share some), so that
// 150 of them are about as many as 50: 90% leaves 1.6 standard deviations of their number, with intervals that are wider than 95%
// by the bias. Passed over five seeds, four of them with the last four scenes.
TEST(PhotonPicturesSlow, AreWithinTheirStatedErrors) {
    Count all;
    const std::vector<const char*> both{"false", "true"}, one{"false"};
    const std::pair<const char*, const std::vector<const char*>&> cases[] = {
        {"cornell-box", both},    {"glass-ball", both},     {"door-ajar", both},    {"glossy-floor", both},
        {"metal-room", both},     {"facing-mirrors", both}, {"outdoor", both},      {"furnace", one},
        {"mitsuba-cornell", one}, {"floating-panels", one}, {"sphere-segment", one}};
    for (const auto& [name, ways] : cases) {
        const Reference& exact = reference(name);
        for (const char* gather : ways) {
            const Blocks photons(
                exact.scene,
                physics::settings_of(exact.scene, make_method({"photon", {{"gather", gather}, {"photons", "16384"}}}), bounces,
                                     physics::fixed_seed + 1, 0.5),
                block, 128);
            const Count count = compare(
                photons, exact,
                {.what = fmt::format("photon, gather {},", gather), .known = 0.02, .bias = [&](auto b, auto q, auto channel) {
                     return photons.at(b, q, channel, 128).bias;
                 }});
            EXPECT_GE(count.within, 0.9 * count.all) << name << ", gather " << gather;
            all += count;
        }
    }
    std::printf("%d of %d within\n", all.within, all.all);
    EXPECT_GE(all.within, 0.95 * all.all);
}

}  // namespace neumann::agreement::photon_test
