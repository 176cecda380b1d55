// Light in narrow gaps, where it goes to and fro: how fast it leaks out, which decides the deep bounces.
#include "core/sampling/sampler.h"
#include "operators/fields/matrix/traced_system.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace neumann::gaps_test {

using namespace physics;

// Two white plates, the lower one 130 × 105 and 0.5 below the upper one: how much of what the lower one sends is still between them
// after i bounces, against walkers that know nothing of patches. 32 million of them tell what is lost to 0.1%; 250,000 here repeat
// it within 4.5 standard errors. Patches without bands along the gap's mouth lose 17% more than the walkers, those with them up to
// 0.9% (the mean of six seeds), and 1024 rays leave a standard error of up to 0.56%: 4.5 of these and the 0.9% are 3.4%. Each of
// the comparisons is beyond 4.5 standard errors in 7 of a million seeds.
TEST(GapsSlow, LeakAsFastAsTheyShould) {
    constexpr double gap = 0.5, upper = 200.0;
    const Vec2 low(-65.0, -52.0), high(65.0, 53.0);
    SceneMaker maker;
    maker.add(parallelogram({-upper, -upper, gap}, {0, 2 * upper, 0}, {2 * upper, 0, 0}), matte(1.0));
    maker.add(parallelogram({low.x, low.y, 0}, {high.x - low.x, 0, 0}, {0, high.y - low.y, 0}), glowing(1.0, 1.0));
    const Scene scene = maker.make();
    constexpr int bounces = 32, walkers = 250'000;
    std::vector<double> walked(bounces + 1);
    Sampler random(7, 0);
    random.start(0);
    for (int k = 0; k < walkers; ++k) {
        Vec2 p = low + random.next2() * (high - low);
        for (int i = 1; i <= bounces; ++i) {
            const Vec3 w = cosine_hemisphere(random.next2());
            p += Vec2(w) * (gap / w.z);
            const bool inside = i % 2 == 1 ? std::max(std::abs(p.x), std::abs(p.y)) < upper
                                           : p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y;
            if (!inside) break;
            walked[static_cast<std::size_t>(i)] += 1.0 / walkers;
        }
    }
    const std::map<int, double> known{{8, 0.04002}, {16, 0.06552}, {24, 0.08610}, {32, 0.10387}};
    for (const auto& [i, lost] : known)
        EXPECT_NEAR(1.0 - walked[static_cast<std::size_t>(i)], lost, 4.5 * std::sqrt(lost * (1.0 - lost) / walkers)) << i;
    for (const std::size_t patches : {4000u, 8000u}) {
        const TracedSystem system(scene, {patches, 1024, 1});
        const TracedChannel K = system.channel(0);
        Vector term = system.emitted(0), next;
        const double sent = K.measure().dot(term);
        for (int i = 1; i <= bounces; ++i) {
            K.apply(term, next);
            term = next;
            if (i % 8 != 0) continue;
            const double lost = known.at(i);
            EXPECT_NEAR(1.0 - K.measure().dot(term) / sent, lost, (0.009 + 4.5 * 0.0056) * lost)
                << patches << " patches, bounce " << i;
        }
    }
}

}  // namespace neumann::gaps_test
