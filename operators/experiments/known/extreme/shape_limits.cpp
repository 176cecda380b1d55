// Needles, and shapes that coincide.
#include "core/sampling/sampler.h"
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/extreme/rectangle_overhead.h"
#include "operators/experiments/known/extreme/unit_cube.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace neumann::known {

Cases extreme_shape_cases() {
    Cases cases;
    // A lamp of 20 × 0.01 cut lengthwise, with an aspect ratio of up to 1 : 128000.
    for (const int pieces : {1, 8, 64})
        cases.push_back({fmt::format("extreme/needles/lamp-of-{}", pieces), "Lambert's formula: exact",
                         [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.5));
                             const Vec3 across(0, 0.01, 0), along(20, 0, 0);
                             maker.add(strips(Vec3(0, 0, 1) - 0.5 * (across + along), across, along, pieces), lamp(2.0));
                             const Scene scene = maker.make();
                             for (const Technique technique : {Technique::mis, Technique::light})
                                 figures.sampled(fmt::format("K Le, {}", short_name(technique)),
                                                 sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), technique,
                                                             {.samples = 1024, .bounces = 1, .seed = seed})
                                                     .terms[1],
                                                 rectangle_overhead(20.0, 0.01, 1.0));
                         }});
    for (const int pieces : {8, 1024})
        cases.push_back(
            {fmt::format("extreme/needles/floor-of-{}", pieces), "rho^i g_i: 2.4e-8", [=](Figures& figures, std::uint64_t seed) {
                 sample_cube(figures, seed, lit_cube(0.8, 1.0, Mat4(1.0), pieces).make());
             }});
    cases.push_back({"extreme/coincident/alike", "as once, but for rounding", [](Figures& figures, std::uint64_t seed) {
                         const auto lit = [&](int copies) {
                             SceneMaker maker;
                             const auto faces = room({0, 0, 0}, {1, 1, 1});
                             for (std::size_t i = 0; i < 6; ++i)
                                 for (int k = 0; k < (i == floor ? copies : 1); ++k)
                                     maker.add(faces[i], i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
                             const Scene scene = maker.make();
                             return probe(scene, at(scene, {0.2, 0.3, 0}, {0, 0, 1}), Technique::mis,
                                          {.samples = 256, .bounces = 6, .seed = seed});
                         };
                         const Estimates once = lit(1);
                         for (const int copies : {2, 5}) {
                             const Estimates found = lit(copies);
                             // A ray to the diagonal of a wall may end on either of its triangles, whose points are rounded
                             // differently.
                             double largest = 0.0;
                             for (std::size_t i = 1; i < once.terms.size(); ++i)
                                 largest = std::max(largest, std::abs(found.terms[i].mean.r / once.terms[i].mean.r - 1.0));
                             figures.at_most(fmt::format("relative difference of terms, {} floors", copies), largest, 8 * eps);
                         }
                     }});
    // Chance decides which of two coincident surfaces is seen. If one of them is a light, a warning is expected.
    cases.push_back(
        {"extreme/coincident/unlike", "warned of; nothing is missed", [](Figures& figures, std::uint64_t seed) {
             SceneMaker maker;
             const auto faces = room({0, 0, 0}, {1, 1, 1});
             for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], glowing(0.5, 1.0));
             maker.add(faces[floor], glowing(0.25, 1.0));
             const Scene scene = maker.make();
             figures.holds("warned of", scene.warnings.counts().count(
                                            "part of a light lies in the same place as another shape: which one is seen is "
                                            "chance, and its light may count twice") > 0);
             int found = 0;
             Sampler random(seed, 0);
             random.start(0);
             for (int k = 0; k < 20000; ++k) {
                 const Vec3 from(random.next(), random.next(), 0.2 + 0.7 * random.next()), to(random.next(), random.next(), 0.0);
                 SurfacePoint p;
                 found += scene.geometry.first_hit(from, glm::normalize(to - from), 1e9, p) && (p.shape == floor || p.shape == 6);
             }
             figures.near("rays to the floor that end on it", found, 20000, 0);
         }});
    // A rug in the plane of the floor is warned of; a box that stands on the floor is not, because its bottom faces the other way.
    cases.push_back({"extreme/coincident/unlike-materials", "warned of", [](Figures& figures, std::uint64_t) {
                         const auto is_warned_of = [](const TriangleMesh& mesh) {
                             SceneMaker maker;
                             maker.add(room({0, 0, 0}, {1, 1, 1}), glowing(0.5, 1.0));
                             maker.add(mesh, matte(0.25));
                             const Scene scene = maker.make();
                             const auto& warnings = scene.warnings.counts();
                             return std::any_of(warnings.begin(), warnings.end(), [](const auto& warning) {
                                 return warning.first.find("made of different materials") != std::string::npos;
                             });
                         };
                         figures.holds("rug", is_warned_of(parallelogram({0.3, 0.4, 0}, {0.31, 0.02, 0}, {-0.03, 0.23, 0})));
                         figures.holds("no box", !is_warned_of(box({0.3, 0.4, 0}, {0.6, 0.7, 0.5})));
                     }});
    // Two overlapping boxes in a furnace: the faces inside are never seen.
    cases.push_back({"extreme/overlapping/boxes", "rho^i: exact", [](Figures& figures, std::uint64_t seed) {
                         SceneMaker maker;
                         maker.add(room({-1, -1, -1}, {1, 1, 1}), glowing(0.8, 1.0));
                         maker.add(box({-0.5, -0.5, -0.5}, {0.2, 0.2, 0.2}), glowing(0.8, 1.0));
                         maker.add(box({-0.1, -0.1, -0.1}, {0.6, 0.6, 0.6}), glowing(0.8, 1.0));
                         maker.add(Sphere{{0.2, 0.2, 0.2}, 0.3, false}, glowing(0.8, 1.0));
                         const Scene scene = maker.make();
                         const Estimates found = probe(scene, at(scene, {0.3, -0.4, -1}, {0, 0, 1}), Technique::bsdf,
                                                       {.samples = 4096, .bounces = 8, .seed = seed});
                         figures.near("K^8 Le", found.terms[8].mean.r, std::pow(0.8, 8), 64 * eps);
                         figures.near("standard error", found.terms[8].standard_error.r, 0.0, 0.0);
                     }});
    cases.push_back({"extreme/no-area", "left out, counted, no bit changes", [](Figures& figures, std::uint64_t seed) {
                         const auto found = [&](bool rubbish) {
                             SceneMaker maker;
                             auto faces = room({0, 0, 0}, {1, 1, 1});
                             if (rubbish)
                                 faces[floor].triangles.insert(faces[floor].triangles.end(), {{0, 0, 1}, {1, 1, 1}, {0, 3, 3}});
                             for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
                             if (rubbish) {
                                 maker.add(triangle({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}), lamp(1e6));
                                 maker.add(Sphere{{0.5, 0.5, 0.5}, 0.0, false}, lamp(1e6));
                             }
                             const Scene scene = maker.make();
                             if (rubbish) {
                                 const auto& counts = scene.warnings.counts();
                                 figures.near(
                                     "warned of: left out",
                                     static_cast<double>(counts.at("degenerate triangle or shape without extent left out")), 5, 0);
                                 figures.near("warned of: lights without area",
                                              static_cast<double>(counts.at("light without area gives off nothing")), 2, 0);
                             }
                             return probe(scene, at(scene, {0.3, 0.4, 0}, {0, 0, 1}), Technique::mis,
                                          {.samples = 64, .bounces = 6, .seed = seed});
                         };
                         const Estimates clean = found(false), littered = found(true);
                         int different = 0;
                         for (std::size_t i = 0; i < clean.terms.size(); ++i)
                             different += clean.terms[i].mean != littered.terms[i].mean;
                         figures.near("terms with other bits", different, 0, 0);
                     }});
    return cases;
}

}  // namespace neumann::known
