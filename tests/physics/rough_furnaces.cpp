// A sphere of a rough metal without absorption: a chord leaves and arrives at the same angle, so that terms are known.
#include "core/base/frame.h"
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics::rough_furnaces_test {

Scene sphere(const Bsdf& bsdf) {
    SceneMaker maker;
    maker.add(Sphere{{0.1, -0.2, 0.3}, 1.7, true}, made_of(bsdf, AreaLight(grey(1.0))));
    return maker.make();
}
// A point of the sphere, seen under an angle.
StartPicker under(const Scene& scene, double mu) {
    const Vec3 n(0.36, 0.48, 0.8);
    const SurfacePoint p = surface_point(scene, Vec3(0.1, -0.2, 0.3) + 1.7 * n, -n);
    return [start = Start{p, Frame(-n).to_world(at_cosine(mu))}](Random&) { return start; };
}

// K, K² and K³ at the cosines 1 and 0.2, α = 0.5 (operators/experiments/known/microfacets.cpp). Lights found in the other ways, and
// the operators; light sampling meets the highlight by chance. 2 angles × 4 ways × 3 bounces, to 1.5%: 24 comparisons.
TEST(RoughFurnaceSlow, AllWaysFindTheSameTerms) {
    const Scene scene = sphere(RoughConductor(Ggx(0.5), {}, Rgb(1.0), Masking::height_correlated));
    for (const auto& [cosine, exact] : {std::pair{1.0, std::vector{0.6878485151102349, 0.47979225079547394, 0.33659055345950384}},
                                        {0.2, std::vector{0.7899291865647029, 0.5594693134406654, 0.3932619909578068}}})
        for (const Technique way : {Technique::mis, Technique::light, Technique::pointwise, Technique::surfaces}) {
            SCOPED_TRACE(name(way) + ", cosine " + std::to_string(cosine));
            expect_matches(probe(scene, under(scene, cosine), way, {.samples = 4096, .bounces = 3}), exact, 1, 0.015);
        }
}

}  // namespace neumann::physics::rough_furnaces_test
