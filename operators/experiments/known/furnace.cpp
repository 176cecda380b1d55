// The white furnace: Le = 1 and albedo ρ everywhere in a closed scene of any shape give K^i Le = ρ^i. There are also
// cases for laws of every closed diffuse scene: flux is conserved, and the light of several emitters adds up.
#include "core/geometry/area_sampler.h"
#include "operators/algebra/term_series.h"
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/spectrum/closure.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::known {

namespace {

// Checks samples without variance in all channels: |K^i Le − ρ^i| ≤ 8 i ε, and a standard error of exactly 0.
void without_variance(Figures& figures, const Estimates& found, const Rgb& rho) {
    double worst = 0.0, spread = 0.0;
    for (std::size_t i = 0; i < found.terms.size(); ++i) {
        const Rgb truth = power_of(rho, static_cast<int>(i));
        const double allowed = 8.0 * static_cast<double>(i) * std::numeric_limits<double>::epsilon();
        for (int c = 0; c < 3; ++c) {
            const double error = std::abs(found.terms[i].mean[c] - truth[c]);
            if (error > 0.0) worst = std::max(worst, error / allowed);
            spread = std::max(spread, found.terms[i].standard_error[c]);
        }
    }
    const int last = static_cast<int>(found.terms.size()) - 1;
    figures.near(fmt::format("K^{} Le, blue", last), found.terms.back().mean.b, std::pow(rho.b, last),
                 8.0 * last * std::numeric_limits<double>::epsilon());
    figures.at_most(fmt::format("max |K^i Le - rho^i|/8i eps, i <= {}", last), worst, 1.0);
    figures.near("largest standard error", spread, 0.0, 0.0);
}

// Adds cases for ρ^i with all i, every technique and every place.
void add_powers(Cases& cases) {
    const Rgb colour(0.25, 0.5, 0.75), bright(0.9, 0.99, 0.9999);
    for (const ClosedScene& enclosure : enclosures({})) {
        const std::string& name = enclosure.name;
        const auto scene_of = [name](const Rgb& rho) {
            for (const ClosedScene& e : enclosures({rho, grey(1.0)}))
                if (e.name == name) return e.maker.make();
            throw std::logic_error("there is no enclosure of this name");
        };
        std::string short_name = name;
        std::replace(short_name.begin(), short_name.end(), ' ', '-');
        for (const Rgb& rho : {colour, bright})
            cases.push_back({fmt::format("furnace/walk/{}/{}", short_name, rho == colour ? "colour" : "bright"), "K^i Le = rho^i",
                             [=](Figures& figures, std::uint64_t seed) {
                                 const Scene scene = scene_of(rho);
                                 without_variance(
                                     figures,
                                     probe(scene, anywhere(scene), Technique::bsdf, {.samples = 64, .bounces = 40, .seed = seed}),
                                     rho);
                             }});
        cases.push_back({"furnace/operators/" + short_name, "K^i Le = rho^i", [=](Figures& figures, std::uint64_t seed) {
                             const Scene scene = scene_of(colour);
                             without_variance(
                                 figures,
                                 probe(scene, anywhere(scene), Technique::pointwise, {.samples = 32, .bounces = 12, .seed = seed}),
                                 colour);
                         }});
        cases.push_back({"furnace/mis/" + short_name, "K^i Le = rho^i", [=](Figures& figures, std::uint64_t seed) {
                             const Scene scene = scene_of(grey(0.9));
                             std::vector<double> exact;
                             for (int i = 0; i <= 8; ++i) exact.push_back(std::pow(0.9, i));
                             figures.terms(sharp_probe(scene, anywhere(scene), Technique::mis, {.samples = 1024, .seed = seed}),
                                           exact, 0);
                         }});
    }
}

// Adds cases for the number of terms until the relative remainder, ρ^(n+1), is small.
void add_lengths(Cases& cases) {
    for (const double rho : {0.5, 0.9, 0.99, 0.999, 0.999999})
        cases.push_back({fmt::format("furnace/terms-needed/albedo-{:g}", rho), "least n with rho^(n+1) <= goal",
                         [=](Figures& figures, std::uint64_t) {
                             // All unknowns are alike, so one stands for all.
                             const DenseChannel K(DenseChannel::Matrix::Constant(1, 1, rho), Vector::Ones(1));
                             TermSeries series(K, Vector::Ones(1));
                             const double L = 1.0 / (1.0 - rho);
                             for (const double goal : {1e-6, 1e-12}) {
                                 // The error of L from rounding the sum and its terms (rounding_errors.cpp); smaller errors cannot
                                 // be seen.
                                 const double rounding = std::numeric_limits<double>::epsilon() * (2.0 + 0.5 * rho / (1.0 - rho));
                                 if (rounding > 0.1 * goal) continue;
                                 while (L - series.sum()[0] > goal * L) series.advance();
                                 const auto needed = [rho](double part) { return std::ceil(std::log(part) / std::log(rho)) - 1.0; };
                                 const double n = needed(goal);
                                 figures.near(fmt::format("terms until {:g} is left", goal), series.bounce(), n,
                                              std::max(n - needed(goal + rounding), needed(goal - rounding) - n));
                             }
                         }});
}

void add_laws(Cases& cases) {
    cases.push_back({"furnace/closure/form-factors", "rows of F sum to 1: exact", [](Figures& figures, std::uint64_t) {
                         for (const int n : {2, 4, 8, 16})
                             figures.near(fmt::format("largest |row sum - 1|, {0} x {0} a face", n),
                                          closure_defect(symmetric_cube(n).channel(1.0)), 0.0, 1e-12);
                     }});
    // Each face of a room emits in turn, each time with a seed of its own.
    cases.push_back(
        {"furnace/superposition/six-faces", "sum of K^i over emitters = rho^i", [](Figures& figures, std::uint64_t seed) {
             const double rho = 0.6;
             const auto faces = room({0, 0, 0}, {1.2, 0.9, 0.7});
             std::vector<Statistic> sums(5);
             for (std::size_t lit = 0; lit < 6; ++lit) {
                 SceneMaker maker;
                 for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == lit ? glowing(rho, 1.0) : matte(rho));
                 const Scene scene = maker.make();
                 const Estimates found = probe(scene, at(scene, {0.4, 0.2, 0.0}, {0, 0, 1}), Technique::mis,
                                               {.samples = 2048, .bounces = 4, .seed = seed + lit});
                 for (std::size_t i = 0; i < sums.size(); ++i) {
                     const Rgb a = sums[i].standard_error, b = found.terms[i].standard_error;
                     sums[i].mean += found.terms[i].mean;
                     sums[i].standard_error = glm::sqrt(a * a + b * b);
                 }
             }
             for (std::size_t i = 1; i <= 4; ++i)
                 figures.sampled(fmt::format("sum of K^{} Le", i), sums[i], std::pow(rho, static_cast<double>(i)));
         }});
    // Σ_{i≥1} ∫ (1 − ρ)/ρ K^i Le dA = ∫ Le dA.
    for (const bool furnished : {false, true})
        cases.push_back({furnished ? "furnace/flux/furnished-room" : "furnace/flux/cube", "absorbed = emitted",
                         [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             std::vector<double> rho;
                             const auto add = [&](Shape shape, double r, double emitted) {
                                 maker.add(std::move(shape), emitted > 0.0 ? glowing(r, emitted) : matte(r));
                                 rho.push_back(r);
                             };
                             const double of_face[6] = {0.2, 0.5, 0.8, 0.9, 0.95, 0.7};
                             const auto faces = room({0, 0, 0}, {1, 1, 1});
                             for (std::size_t i = 0; i < 6; ++i)
                                 add(faces[i], of_face[i], i == ceiling ? 1.0 : i == left ? 0.3 : 0.0);
                             if (furnished) {
                                 add(box({0.2, 0.3, 0.1}, {0.4, 0.7, 0.5}), 0.6, 0.0);
                                 add(Sphere{{0.7, 0.6, 0.4}, 0.2, false}, 0.85, 0.0);
                                 add(Sphere{{0.6, 0.3, 0.8}, 0.05, false}, 0.3, 2.0);
                             }
                             const Scene scene = maker.make();
                             const double emitted = 1.0 + 0.3 + (furnished ? 2.0 * 4.0 * pi * 0.05 * 0.05 : 0.0);
                             const StartPicker absorbed = [pick = anywhere(scene), rho](Random& random) {
                                 Start start = pick(random);
                                 const double r = rho[start.point.shape];
                                 start.weight = grey((1.0 - r) / r);
                                 return start;
                             };
                             for (const Technique technique : {Technique::mis, Technique::bsdf})
                                 figures.sampled(
                                     fmt::format("absorbed/emitted, {}", short_name(technique)),
                                     scaled(sharp_probe(scene, absorbed, technique,
                                                        {.samples = 1024, .bounces = 0, .rest_probability = 1.0, .seed = seed})
                                                .reflected,
                                            AreaSampler(scene.geometry).area() / emitted),
                                     1.0);
                         }});
    // ∫ K^i Le dA = ρ^i ∫ Le dA, on a mesh that approximates its sphere badly.
    cases.push_back({"furnace/flux/icosphere-320", "area mean of K^i Le = rho^i x emitting part of the area",
                     [](Figures& figures, std::uint64_t seed) {
                         const double rho = 0.7;
                         const TriangleMesh sphere = flipped(icosphere(2));
                         const auto in_cap = [](const Vec3& p) { return glm::normalize(p).z > std::cos(pi / 9.0); };
                         SceneMaker maker;
                         maker.add(part(sphere, in_cap), glowing(rho, 1.0));
                         maker.add(part(sphere, [&](const Vec3& p) { return !in_cap(p); }), matte(rho));
                         const Scene scene = maker.make();
                         const double fraction = scene.geometry.area(0) / (scene.geometry.area(0) + scene.geometry.area(1));
                         figures.near("emitting part of the area", fraction, 0.018868107508640625, 1e-12);
                         std::vector<double> exact;
                         for (int i = 1; i <= 6; ++i) exact.push_back(fraction * std::pow(rho, i));
                         figures.terms(
                             sharp_probe(scene, anywhere(scene), Technique::mis, {.samples = 1024, .bounces = 6, .seed = seed}),
                             exact);
                     }});
}

}  // namespace

Cases furnace_cases() {
    Cases cases;
    add_powers(cases);
    add_lengths(cases);
    add_laws(cases);
    return cases;
}

}  // namespace neumann::known
