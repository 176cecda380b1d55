// Furnaces of rough metals without absorption: GGX has known albedos, and known terms in a sphere, where a chord leaves and arrives
// at the same angle.
#include "core/base/frame.h"
#include "operators/known/quadrature.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

// Without absorption: K^1 in any furnace, and K², K³ in a sphere, at the cosines above. Refined quadrature, error below 3e-11.
struct Furnace {
    double alpha;
    Masking masking;
    double K[3][5];
};
constexpr Masking separable = Masking::separable, correlated = Masking::height_correlated;
constexpr Furnace furnaces[] = {
    {0.05,
     correlated,
     {{0.9972958684886749, 0.9964610489127447, 0.992715568676465, 0.9626413714368639, 0.8898940542709174},
      {0.9944092644218021, 0.9925976870577312, 0.9843946508181635, 0.9278006569127344, 0.8359237795829315},
      {0.9913523916877032, 0.9884303332999086, 0.9752681252266611, 0.89841244467163, 0.8009620374513794}}},
    {0.1,
     correlated,
     {{0.98830405652061, 0.9845664009589696, 0.9692049844116873, 0.9045591390900806, 0.9117625109899107},
      {0.9749740329411407, 0.9667123516602663, 0.9360178921967758, 0.8447054478487186, 0.8500260278583137},
      {0.9601370503277674, 0.9470441410818642, 0.9037488332574413, 0.8011877744725642, 0.8066401398301474}}},
    {0.3,
     correlated,
     {{0.8773584157886108, 0.8564618682398077, 0.821711003150764, 0.8385118885795944, 0.9314233700249317},
      {0.7526566367855912, 0.7276160257933006, 0.6917314468695426, 0.7050632174407565, 0.7844199431189764},
      {0.640413868719281, 0.6171793345629895, 0.5850862051116865, 0.5958557139901115, 0.662962133835868}}},
    {0.5,
     correlated,
     {{0.6878485151102349, 0.682045682100857, 0.6982506969275464, 0.7899291865647029, 0.9125477979647583},
      {0.47979225079547394, 0.4775103579332217, 0.491640387932416, 0.5594693134406654, 0.6508783211930791},
      {0.33659055345950384, 0.3352114733530746, 0.3453904533344045, 0.3932619909578068, 0.457757400701781}}},
    {1.0,
     correlated,
     {{0.30685281944005405, 0.35125582702693614, 0.4506938556659439, 0.6416481061543873, 0.8477738781138267},
      {0.13045364017646421, 0.15028738109118173, 0.19580235030237877, 0.2884693817183432, 0.4001660496268778},
      {0.05680582885607941, 0.06548273367266313, 0.08544370997232612, 0.12633850766296864, 0.17628811977725173}}},
    {0.1,
     separable,
     {{0.98830405652061, 0.9845616591713482, 0.9691151156162598, 0.9020759357479455, 0.8859703604742817},
      {0.9749240612899952, 0.9666118618282766, 0.9355217306918575, 0.8400299340645552, 0.8230511366711646},
      {0.9600059739250383, 0.9467891751112378, 0.9027539322276812, 0.7954516998767764, 0.780044194854683}}},
    {0.5,
     separable,
     {{0.6878485151102349, 0.6796372943669574, 0.6860072499737109, 0.7389776450698403, 0.7922764509034017},
      {0.4734628815971641, 0.4684794365798809, 0.4739208270887925, 0.5110452686894991, 0.5477503334167224},
      {0.3265615258997839, 0.3231953892658029, 0.3270208102370902, 0.352665335199108, 0.37799045360493755}}},
    {1.0,
     separable,
     {{0.30685281944005405, 0.3409475771556155, 0.40913709258673847, 0.5114213657334232, 0.584481560838198},
      {0.11853551384343256, 0.13170612649270275, 0.15804735179124327, 0.19755918973905412, 0.2257819311303476},
      {0.045789600590166596, 0.050877333989073965, 0.061052800786888746, 0.07631600098361095, 0.08721828683841253}}}};

TEST(RoughFurnace, TheAlbedoOfGgxIsThatOfTheTable) {
    for (const Furnace& f : furnaces)
        for (std::size_t k = 0; k < 5; ++k)
            EXPECT_NEAR(albedo(RoughConductor(Ggx(f.alpha), {}, Rgb(1.0), f.masking), cosines[k]), f.K[0][k], 1e-9)
                << "alpha " << f.alpha << ", cosine " << cosines[k];
}

// α = 1, separable: fs has in a sphere the eigenfunction 1/(1 + μ) with the eigenvalue 2 ln 2 − 1,
// which is the spectral radius, and K1 = 2 (1 − ln 2)/(1 + μ).
TEST(RoughFurnace, TheRoughestGgxHasItsEigenvalue) {
    const Bsdf bsdf = RoughConductor(Ggx(1.0));
    const double ln2 = std::log(2.0);
    for (const double mu : cosines) {
        EXPECT_NEAR(albedo(bsdf, mu), 2.0 * (1.0 - ln2) / (1.0 + mu), 1e-10);
        const double reflected =
            over_hemisphere(mu, 1e-11, [&](const Vec3& wi) { return eval(bsdf, {}, at_cosine(mu), wi).r * wi.z / (1.0 + wi.z); });
        EXPECT_NEAR(reflected * (1.0 + mu), 2.0 * ln2 - 1.0, 1e-10);
    }
}

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

// 8 materials × 5 angles × 3 bounces, to 0.4%: 120 comparisons.
TEST(RoughFurnaceSlow, TermsInASphereAreThoseOfTheTable) {
    for (const Furnace& f : furnaces) {
        const Scene scene = sphere(RoughConductor(Ggx(f.alpha), {}, Rgb(1.0), f.masking));
        for (std::size_t k = 0; k < 5; ++k) {
            SCOPED_TRACE("alpha " + std::to_string(f.alpha) + ", cosine " + std::to_string(cosines[k]));
            expect_matches(probe(scene, under(scene, cosines[k]), Way::bsdf, {.samples = 8192, .bounces = 3}),
                           std::vector{f.K[0][k], f.K[1][k], f.K[2][k]}, 1, 0.004);
        }
    }
}

// Lights found in the other ways, and the operators; light sampling meets the highlight by chance. 2 angles × 4 ways × 3 bounces,
// to 1.5%: 24 comparisons.
TEST(RoughFurnaceSlow, AllWaysFindTheSameTerms) {
    const Furnace& f = furnaces[3];
    const Scene scene = sphere(RoughConductor(Ggx(f.alpha), {}, Rgb(1.0), f.masking));
    for (const std::size_t k : {0, 3})
        for (const Way way : {Way::mis, Way::light, Way::pointwise, Way::surfaces}) {
            SCOPED_TRACE(name(way) + ", cosine " + std::to_string(cosines[k]));
            expect_matches(probe(scene, under(scene, cosines[k]), way, {.samples = 8192, .bounces = 3}),
                           std::vector{f.K[0][k], f.K[1][k], f.K[2][k]}, 1, 0.015);
        }
}

// K^i = 2 (1 − ln 2)/(1 + μ) (2 ln 2 − 1)^(i−1), as above. 3 angles × 2 ways × 6 bounces, to 1.5%: 36 comparisons.
TEST(RoughFurnaceSlow, TheRoughestGgxHasAGeometricSeries) {
    const Scene scene = sphere(RoughConductor(Ggx(1.0)));
    const double ln2 = std::log(2.0);
    for (const double mu : {1.0, 0.5, 0.05})
        for (const Way way : {Way::mis, Way::bsdf}) {
            SCOPED_TRACE(name(way) + ", cosine " + std::to_string(mu));
            std::vector<double> exact;
            for (int i = 1; i <= 6; ++i) exact.push_back(2.0 * (1.0 - ln2) / (1.0 + mu) * std::pow(2.0 * ln2 - 1.0, i - 1));
            expect_matches(probe(scene, under(scene, mu), way, {.samples = 16384, .bounces = 6}), exact, 1, 0.015);
        }
}

}  // namespace
}  // namespace neumann::physics
