// Mirrors: light goes one way only, so that every term is a product along a path that geometry gives, without variance, in
// whichever way lights are looked for.
#include "core/base/error.h"
#include "core/sampling/warp.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace neumann::physics::mirrors_test {

constexpr Technique ways[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise};
constexpr double rho = 0.9;

Conductor mirror() { return Conductor({}, grey(rho)); }

// Few samples are enough: all have to be the same.
ProbeSettings probe_settings(Technique technique, int bounces) {
    return {.samples = 2, .bounces = technique == Technique::pointwise ? std::min(bounces, 12) : bounces};
}

// A diffuse floor lit by a lamp that it sees in a mirror only, as if the lamp were behind it: K^2 Le = ρ_floor ρ F, F the form
// factor of the mirrored lamp, here of a disc at height h seen from a point below its centre, r²/(r² + h²), less
// s²/(π h²) of the floor itself, a small square that hides a little of the lamp. Light sampling has to find it by walking on. 3
// ways, to 0.5%: 3 comparisons.
TEST(MirrorsSlow, ALampSeenInAMirrorLightsTheFloor) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.5));
    maker.add(patch({0, 0, 1}, {0, 0, -1}, 1.0), made_of(mirror()));
    maker.add(Disk{{0, 0, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}, lamp(1.0));
    const Scene scene = maker.make();
    const double F = 4.0 / (4.0 + 9.0) - 0.02 * 0.02 / (pi * 4.0);
    for (const Technique technique : {Technique::mis, Technique::bsdf, Technique::light}) {
        SCOPED_TRACE(name(technique));
        expect_matches(probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), technique, {.samples = 16384, .bounces = 3}),
                       std::vector{0.0, 0.0, 0.5 * rho * F, 0.0}, 0, 0.005);
    }
}

TEST(Mirrors, TheBackIsBlackUnlessTwoSided) {
    for (const bool two_sided : {false, true}) {
        SceneMaker maker;
        Surface surface = made_of(mirror());
        surface.two_sided = two_sided;
        maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), surface);
        maker.add(patch({0, 0, -2}, {0, 0, 1}, 1.0), lamp(1.0));
        const Scene scene = maker.make();
        for (const Technique technique : ways) {
            const Estimates found = probe(scene, seen(scene, {0.1, 0.2, -1}, {0, 0, 1}), technique, probe_settings(technique, 2));
            expect_exact(found, [=](int i) { return grey(two_sided && i == 1 ? rho : 0.0); });
        }
    }
}

TEST(Mirrors, ReflectionOverSurfacesRefusesThem) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), made_of(mirror(), grey(1.0)));
    const Scene scene = maker.make();
    try {
        probe(scene, at(scene, {0.1, 0.2, 0}, {0, 0, 1}), Technique::surfaces, {.samples = 1, .bounces = 1});
        FAIL();
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(), "reflection over surfaces is not possible with mirrors, expected diffuse or rough materials");
    }
}

}  // namespace neumann::physics::mirrors_test
