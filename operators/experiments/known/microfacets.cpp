// Rough metals without absorption and with single scattering: GGX has known albedos, which are K Le of any furnace, and
// known terms in a sphere, where a chord leaves and arrives at the same angle. The values are from refined quadrature,
// with an error below 3e-11, checked by sampling visible normals.
#include "core/base/frame.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/quadrature.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

// K[k]: K, K², K³ at `cosines`.
struct RoughFurnace {
    double alpha;
    Masking masking;
    double K[3][5];
    bool is_separable() const { return masking == Masking::separable; }
    Bsdf bsdf() const { return RoughConductor(Ggx(alpha), {}, Rgb(1.0), masking); }
};
constexpr Masking separable = Masking::separable, correlated = Masking::height_correlated;
constexpr RoughFurnace furnaces[] = {
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

Scene sphere(const Bsdf& bsdf) {
    SceneMaker maker;
    maker.add(Sphere{{0.1, -0.2, 0.3}, 1.7, true}, made_of(bsdf, AreaLight(grey(1.0))));
    return maker.make();
}
// A start at a point of the sphere, seen at this cosine.
StartPicker under(const Scene& scene, double mu) {
    const Vec3 n(0.36, 0.48, 0.8);
    const SurfacePoint p = surface_point(scene, Vec3(0.1, -0.2, 0.3) + 1.7 * n, -n);
    return [start = Start{p, Frame(-n).to_world(at_cosine(mu))}](Random&) { return start; };
}

}  // namespace

Cases microfacet_cases() {
    Cases cases;
    for (const RoughFurnace& f : furnaces) {
        const std::string name = fmt::format("ggx-{:g}-{}", f.alpha, f.is_separable() ? "separable" : "correlated");
        cases.push_back({"microfacets/albedo/" + name, "quadrature, 3e-11", [f](Figures& figures, std::uint64_t) {
                             for (std::size_t k = 0; k < 5; ++k)
                                 figures.near(fmt::format("K Le, cosine {:g}", cosines[k]), albedo(f.bsdf(), cosines[k]), f.K[0][k],
                                              1e-9);
                         }});
        cases.push_back({"microfacets/sphere/" + name, "quadrature, 3e-11", [f](Figures& figures, std::uint64_t seed) {
                             const Scene scene = sphere(f.bsdf());
                             for (const std::size_t k : {0, 2, 4}) {
                                 const Estimates found = sharp_probe(scene, under(scene, cosines[k]), Technique::bsdf,
                                                                     {.samples = 1024, .bounces = 3, .seed = seed});
                                 for (std::size_t i = 1; i <= 3; ++i)
                                     figures.sampled(fmt::format("K^{} Le, cosine {:g}", i, cosines[k]), found.terms[i],
                                                     f.K[i - 1][k]);
                             }
                         }});
    }
    // 1/(1 + μ) is an eigenfunction with the eigenvalue 2 ln 2 − 1, the spectral radius.
    cases.push_back(
        {"microfacets/eigenvalue/ggx-1", "2 ln 2 - 1: exact", [](Figures& figures, std::uint64_t) {
             const Bsdf bsdf = RoughConductor(Ggx(1.0));
             const double ln2 = std::log(2.0);
             for (const double mu : cosines) {
                 figures.near(fmt::format("K Le, cosine {:g}", mu), albedo(bsdf, mu), 2.0 * (1.0 - ln2) / (1.0 + mu), 1e-10);
                 const double reflected = over_hemisphere(
                     mu, 1e-11, [&](const Vec3& wi) { return eval(bsdf, {}, at_cosine(mu), wi).r * wi.z / (1.0 + wi.z); });
                 figures.near(fmt::format("eigenvalue, cosine {:g}", mu), reflected * (1.0 + mu), 2.0 * ln2 - 1.0, 1e-10);
             }
         }});
    for (const Technique technique : {Technique::mis, Technique::bsdf})
        cases.push_back({"microfacets/series/ggx-1-" + short_name(technique), "2(1 - ln 2)/(1 + mu) (2 ln 2 - 1)^(i-1): exact",
                         [technique](Figures& figures, std::uint64_t seed) {
                             const Scene scene = sphere(RoughConductor(Ggx(1.0)));
                             const double ln2 = std::log(2.0);
                             std::vector<double> exact;
                             for (int i = 1; i <= 4; ++i)
                                 exact.push_back(2.0 * (1.0 - ln2) / 1.5 * std::pow(2.0 * ln2 - 1.0, i - 1));
                             figures.terms(
                                 sharp_probe(scene, under(scene, 0.5), technique, {.samples = 1024, .bounces = 4, .seed = seed}),
                                 exact);
                         }});
    return cases;
}

}  // namespace neumann::known
