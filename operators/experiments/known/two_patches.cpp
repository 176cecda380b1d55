// Two surfaces, each of which sees itself and the other equally from all its points: K = [ρ1 F11, ρ1 F12; ρ2 F21, ρ2 F22] is exact.
// Values are constant on each surface, up to the rim where they meet. One eigenvalue is negative, so the terms alternate.
//
//     concentric spheres, inner seen from outside:  F12 = 1,  F21 = (r1/r2)²,  F22 = 1 − F21;
//     a sphere closed by a disc, with the fraction f of the sphere's area:  F_dd = 0, F_ds = 1, F_sd = 1 − f, F_ss = f.
#include "operators/algebra/term_series.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

std::array<std::vector<double>, 2> terms_of(const DenseChannel& K, const Vector& Le, int count) {
    std::array<std::vector<double>, 2> result;
    TermSeries series(K, Le);
    for (int i = 0; i < count; ++i, series.advance())
        for (Eigen::Index k = 0; k < 2; ++k) result[static_cast<std::size_t>(k)].push_back(series.term()[k]);
    return result;
}

// Adds the matrix, compared with published figures, and its eigenvalues, (tr ± √(tr² − 4 det))/2.
void add_matrix(Cases& cases, const std::string& name, DenseChannel (*matrix)(), std::vector<std::array<double, 2>> known,
                std::array<const char*, 2> surfaces) {
    cases.push_back({"two-patches/" + name + "/matrix", "2 x 2 matrix: exact", [=](Figures& figures, std::uint64_t) {
                         const DenseChannel K = matrix();
                         const auto found = terms_of(K, vector({1, 0}), static_cast<int>(known.size()));
                         for (std::size_t i = 1; i < known.size(); ++i)
                             for (std::size_t k = 0; k < 2; ++k)
                                 figures.near(fmt::format("K^{} Le, {}", i, surfaces[k]), found[k][i], known[i][k], 1e-15);
                         const Eigenpairs pairs = leading_eigenpairs(K, 2);
                         const auto& m = K.matrix();
                         const double trace = m(0, 0) + m(1, 1),
                                      root = std::sqrt(trace * trace - 4.0 * (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0)));
                         figures.near("first eigenvalue", pairs.pairs.at(0).value.real(), 0.5 * (trace + root), 1e-14);
                         figures.near("second eigenvalue", pairs.pairs.at(1).value.real(), 0.5 * (trace - root), 1e-14);
                     }});
}

void add_dome(Cases& cases, double f, bool disc_glows) {
    for (const Technique technique : {Technique::mis, Technique::bsdf}) {
        if (technique == Technique::bsdf && f != 0.5) continue;
        cases.push_back(
            {fmt::format("two-patches/dome-{:g}-{}/{}", f, disc_glows ? "from-disc" : "from-dome", short_name(technique)),
             "2 x 2 matrix: exact", [=](Figures& figures, std::uint64_t seed) {
                 // The chamber is above the plane z = 1 − 2 f; the part of the sphere below is shut off by the disc's black back.
                 const double rho_disc = 0.7, rho_sphere = 0.5, height = 1.0 - 2.0 * f, rim = std::sqrt(1.0 - height * height);
                 const auto surface = [](double rho, bool glows) { return glows ? glowing(rho, 1.0) : matte(rho); };
                 SceneMaker maker;
                 maker.add(Disk{{0, 0, height}, {rim, 0, 0}, {0, rim, 0}, {0, 0, 1}}, surface(rho_disc, disc_glows));
                 maker.add(Sphere{{0, 0, 0}, 1.0, true}, surface(rho_sphere, !disc_glows));
                 const Scene scene = maker.make();
                 const auto exact = terms_of(two_by_two(0.0, rho_disc, rho_sphere * (1 - f), rho_sphere * f, 1.0, 1.0),
                                             vector({disc_glows ? 1.0 : 0.0, disc_glows ? 0.0 : 1.0}), 7);
                 const ProbeSettings settings{.samples = 1024, .bounces = 5, .seed = seed};
                 const auto add = [&](const std::string& where, const StartPicker& start, const std::vector<double>& values) {
                     const Estimates found = sharp_probe(scene, start, technique, settings);
                     for (std::size_t i = 1; i <= 5; ++i)
                         figures.sampled(fmt::format("K^{} Le, {}", i, where), found.terms[i], values[i]);
                 };
                 const double r = rim - 1e-3, z = height + 1e-4, s = std::sqrt(1.0 - z * z);
                 add("disc, middle", at(scene, {0, 0, height}, {0, 0, 1}, 1e-5), exact[0]);
                 add("disc, rim", at(scene, {r * 0.6, r * 0.8, height}, {0, 0, 1}, 1e-5), exact[0]);
                 add("dome, rim", at(scene, {0.6 * s, 0.8 * s, z}, -Vec3(0.6 * s, 0.8 * s, z), 1e-5), exact[1]);
             }});
    }
}

void add_concentric(Cases& cases, double inner, int bounces) {
    for (const Technique technique : {Technique::mis, Technique::bsdf, Technique::light}) {
        if (technique == Technique::light && inner > 0.5) continue;  // too noisy in a narrow gap
        cases.push_back({fmt::format("two-patches/spheres-{:.2g}/{}", inner, short_name(technique)), "2 x 2 matrix: exact",
                         [=](Figures& figures, std::uint64_t seed) {
                             const double rho = 0.9, F21 = inner * inner;
                             SceneMaker maker;
                             maker.add(Sphere{{1, 2, 3}, inner, false}, glowing(rho, 1.0));
                             maker.add(Sphere{{1, 2, 3}, 1.0, true}, matte(rho));
                             const Scene scene = maker.make();
                             const auto exact = terms_of(two_by_two(0.0, rho, rho * F21, rho * (1.0 - F21), F21, 1.0),
                                                         vector({1, 0}), bounces + 1);
                             const Vec3 n(0.48, 0.64, 0.6);
                             const ProbeSettings settings{.samples = 1024, .bounces = bounces, .seed = seed};
                             const Estimates on_inner =
                                                 sharp_probe(scene, at(scene, Vec3(1, 2, 3) + n * inner, n), technique, settings),
                                             on_outer = sharp_probe(scene, at(scene, Vec3(1, 2, 3) + n, -n), technique, settings);
                             for (int i = 1; i <= bounces; ++i) {
                                 const auto k = static_cast<std::size_t>(i);
                                 figures.sampled(fmt::format("K^{} Le, inner", i), on_inner.terms[k], exact[0][k]);
                                 figures.sampled(fmt::format("K^{} Le, outer", i), on_outer.terms[k], exact[1][k]);
                             }
                         }});
    }
}

}  // namespace

Cases two_patch_cases() {
    Cases cases;
    add_matrix(cases, "dome", dome,
               {{{1, 0}}, {{0, .25}}, {{.175, .0625}}, {{.04375, .059375}}, {{.0415625, .02578125}}, {{.018046875, .0168359375}}},
               {"disc", "dome"});
    add_matrix(cases, "plates", plates,
               {{{1, 0}},
                {{0, .88209}},
                {{.793881, .0157982319}},
                {{.01421840871, .7005574376233291}},
                {{.6305016938609962, .02508889984683773}},
                {{.022580009862153957, .5566085813341031}},
                {{.5009477232006928, .02988646059100118}}},
               {"inner", "outer"});
    for (const double f : {0.5, 0.75, 0.25})
        for (const bool disc_glows : {true, false}) add_dome(cases, f, disc_glows);
    add_concentric(cases, 0.99, 8);
    add_concentric(cases, 1.0 / 3.0, 4);
    return cases;
}

}  // namespace neumann::known
