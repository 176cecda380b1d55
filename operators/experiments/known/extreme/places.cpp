// The cube and a furnace larger, smaller, turned, and elsewhere.
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/extreme/unit_cube.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace neumann::known {

Cases extreme_place_cases() {
    Cases cases;
    struct Placement {
        const char* name;
        double size;
        Vec3 to;  // in units of size
    };
    for (const Placement& placement : {Placement{"scale-1e-6", 1e-6, Vec3(0.0)},
                                       {"scale-1e6", 1e6, Vec3(0.0)},
                                       {"scale-1e-6-away", 1e-6, {1.1, -0.7, 0.3}},
                                       {"1e5-sizes-away", 1.0, {1.1e5, -0.7e5, 0.3e5}},
                                       {"1e6-away-scale-1e3", 1e3, {1.1e3, -0.7e3, 0.3e3}}}) {
        const Mat4 to_world =
            glm::scale(glm::rotate(glm::translate(Mat4(1.0), placement.to * placement.size), 1.1, glm::normalize(Vec3(1, 2, 3))),
                       Vec3(placement.size));
        cases.push_back(
            {fmt::format("extreme/{}/cube", placement.name), "rho^i g_i: 2.4e-8", [=](Figures& figures, std::uint64_t seed) {
                 sample_cube(figures, seed, lit_cube(0.8, 1.0, to_world).make(), to_world);
             }});
        // There is no variance, so any ray that slips through a wall or hits the surface it leaves is noticed.
        cases.push_back(
            {fmt::format("extreme/{}/furnace", placement.name), "rho^i: exact", [=](Figures& figures, std::uint64_t seed) {
                 SceneMaker maker;
                 for (const TriangleMesh& face : room({0, 0, 0}, {1, 1, 1}))
                     maker.add(transformed(face, to_world), glowing(0.8, 1.0));
                 const Scene scene = maker.make();
                 const Estimates found =
                     probe(scene, anywhere(scene), Technique::bsdf, {.samples = 1024, .bounces = 8, .seed = seed});
                 figures.near("K^8 Le", found.terms[8].mean.r, std::pow(0.8, 8), 64 * eps);
                 figures.near("standard error", found.terms[8].standard_error.r, 0.0, 0.0);
             }});
    }
    return cases;
}

}  // namespace neumann::known
