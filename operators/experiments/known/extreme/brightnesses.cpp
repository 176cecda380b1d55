#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/extreme/unit_cube.h"

#include <fmt/format.h>

namespace neumann::known {

Cases extreme_brightness_cases() {
    Cases cases;
    for (const double radiance : {1e-30, 1e30, 1e150})
        cases.push_back({fmt::format("extreme/radiance-{:g}/cube", radiance), "rho^i g_i Le: 2.4e-8",
                         [=](Figures& figures, std::uint64_t seed) {
                             sample_cube(figures, seed, lit_cube(0.8, radiance).make(), Mat4(1.0), radiance);
                         }});
    cases.push_back({"extreme/radiance-2^k/cube", "the same bits", [](Figures& figures, std::uint64_t seed) {
                         const auto found = [&](int k) {
                             const Scene scene = lit_cube(0.8, std::ldexp(1.0, k)).make();
                             return probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), Technique::mis,
                                          {.samples = 128, .bounces = 8, .seed = seed});
                         };
                         const Estimates one = found(0);
                         // 2^-900 = 1e-271; far below, the numbers added to means are subnormal and have fewer bits.
                         for (const int k : {-900, -100, -20, 10, 60, 100}) {
                             const Estimates other = found(k);
                             int different = 0;
                             for (std::size_t i = 0; i < one.terms.size(); ++i) {
                                 different += std::ldexp(one.terms[i].mean.r, k) != other.terms[i].mean.r;
                                 // The square of a standard error must not underflow.
                                 if (k > -500)
                                     different += std::ldexp(one.terms[i].standard_error.r, k) != other.terms[i].standard_error.r;
                             }
                             figures.near(fmt::format("values with other bits, k = {}", k), different, 0, 0);
                         }
                     }});
    return cases;
}

}  // namespace neumann::known
