// The white furnace: Le = 1 and albedo ρ everywhere in a closed scene of any shape give K^i Le = ρ^i. A sample that never looks for
// lights carries exactly ρ^i, so there is no variance, and rounding is all that remains: |K^i Le − ρ^i| ≤ 8 i ε.
#include "operators/experiments/known/enclosures.h"
#include "operators/render/methods/render.h"
#include "tests/physics/probe.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::furnace_test {

const Rgb colour(0.25, 0.5, 0.75);

TEST(Furnace, EveryPixelIsThePowerOfTheAlbedo) {
    for (ClosedScene& enclosure : enclosures({colour, grey(1.0)})) {
        enclosure.maker.parts.camera.fov = 2.0;
        enclosure.maker.parts.camera.near_clip = 1e-6;
        enclosure.maker.parts.film = {8, 6, 0, 0, 8, 6};
        const Scene scene = enclosure.maker.make();
        for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol})
            for (const Method& method :
                 {Method(method::Walk{{sampler}, {DirectLight::bsdf}}), Method(method::Pointwise{{sampler}})}) {
                SCOPED_TRACE(enclosure.name + (sampler == SamplerKind::sobol ? ", Sobol', " : ", independent, ") + name_of(method));
                const BounceSeries pictures = render(scene, method, {.bounces = 10, .samples = 32, .seed = fixed_seed});
                for (int i = 0; i <= 10; ++i) {
                    const Estimate term = pictures.term(static_cast<std::size_t>(i));
                    double error = 0.0, spread = 0.0;
                    for (const Rgb& x : term.mean.pixels) error = std::max(error, max_component(glm::abs(x - power_of(colour, i))));
                    for (const Rgb& x : term.standard_error.pixels) spread = std::max(spread, max_component(x));
                    EXPECT_LE(error, 8.0 * i * std::numeric_limits<double>::epsilon()) << "K^" << i << " Le";
                    EXPECT_EQ(spread, 0.0) << "K^" << i << " Le";
                }
                EXPECT_EQ(std::get<PathRecord>(pictures.record).health->non_finite(), 0u);
            }
    }
}

TEST(Furnace, WithoutReflectionNothingComesBack) {
    for (const ClosedScene& enclosure : enclosures(glowing(0.0, 1.0))) {
        SCOPED_TRACE(enclosure.name);
        const Scene scene = enclosure.maker.make();
        for (const Technique way : {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise})
            expect_exact(probe(scene, anywhere(scene), way, {.samples = 16, .rest_probability = 1.0}),
                         [](int i) { return grey(i == 0 ? 1.0 : 0.0); });
    }
}

TEST(Furnace, WithoutAbsorptionEveryTermIsOneAndTheWalksAreGivenUp) {
    for (const ClosedScene& enclosure : enclosures(glowing(1.0, 1.0))) {
        SCOPED_TRACE(enclosure.name);
        const Scene scene = enclosure.maker.make();
        const Estimates found =
            probe(scene, anywhere(scene), Technique::bsdf, {.samples = 16, .bounces = 30, .rest_probability = 1.0, .give_up = 100});
        expect_exact(found, [](int) { return grey(1.0); });
        EXPECT_EQ(found.given_up, found.samples);
    }
}

// Beyond the last picture: Σ_{i>N} ρ^i = ρ^(N+1) / (1 − ρ), by walks that roulette ends. 6 comparisons.
TEST(FurnaceSlow, TheRestIsTheTailOfTheGeometricSeries) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.8, 1.0));
    const Scene scene = maker.make();
    for (const double go_on : {1.0, 0.5})
        for (const Technique way : {Technique::mis, Technique::bsdf, Technique::light}) {
            SCOPED_TRACE(name(way));
            const Estimates found = probe(scene, anywhere(scene), way,
                                          {.samples = go_on < 1.0 ? 16384u : 8192u, .bounces = 3, .rest_probability = go_on});
            expect_matches(found.rest, std::pow(0.8, 4) / 0.2, "rest");
        }
}

}  // namespace neumann::physics::furnace_test
