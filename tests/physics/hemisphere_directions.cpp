// Walks that go on over the hemisphere, whatever the material.
#include "operators/experiments/known/enclosures.h"
#include "tests/physics/measured.h"

#include <gtest/gtest.h>

namespace neumann::physics::hemisphere_directions_test {

using known::ClosedScene;

// In a furnace of albedo ρ a sample of K^i Le is a product of i independent factors ρ cosθ / (π p). By the cosine they are ρ, and
// there is no variance. Uniformly they are 2 ρ cosθ, whose mean is ρ and mean square 4/3 ρ²: the variance is ρ^2i ((4/3)^i − 1).
// Independent samples of one pixel; the variance of 64 replicates of 64 samples has an error of 18%, and by heavy tails of more in
// later bounces: 3 bounces × 8 rooms, 4.5 errors each.
TEST(HemisphereDirections, HaveTheirVarianceInAFurnace) {
    constexpr double albedo = 0.5;
    constexpr std::uint64_t samples = 64 * 64;
    for (ClosedScene& enclosure : known::enclosures({grey(albedo), grey(1.0)})) {
        enclosure.maker.parts.film = one_pixel();
        const Scene scene = enclosure.maker.make();
        for (const auto density : {HemisphereDensity::cosine, HemisphereDensity::uniform}) {
            method::Walk walk{{SamplerKind::independent}, {DirectLight::bsdf}};
            walk.indirect = density;
            const BounceSeries found =
                render(scene, walk, {.bounces = 3, .samples = samples, .replicates = 64, .seed = fixed_seed});
            for (int i = 1; i <= 3; ++i) {
                SCOPED_TRACE(enclosure.name + ", bounce " + std::to_string(i));
                const MeanWithError& m = found.report.bounces[static_cast<std::size_t>(i)].mean;
                const double mean = std::pow(albedo, i);
                if (density == HemisphereDensity::cosine) {
                    EXPECT_NEAR(m.mean, mean, 1e-14);
                    EXPECT_NEAR(m.standard_error, 0.0, 1e-14);
                } else {
                    const double variance = mean * mean * (std::pow(4.0 / 3.0, i) - 1.0) / samples;
                    EXPECT_NEAR(m.mean, mean, 4.5 * std::sqrt(variance));
                    EXPECT_NEAR(m.standard_error * m.standard_error, variance, 4.5 * 0.2 * variance);
                }
            }
        }
    }
}

}  // namespace neumann::physics::hemisphere_directions_test
