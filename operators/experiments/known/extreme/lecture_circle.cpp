// The circle of a lecture on path tracing (CS184, lecture 13) at (1930.420, 1973.505), radius 1: in single precision a ray from the
// origin to its centre misses the surface by so much that shadows become noisy.
#include "core/sampling/sampler.h"
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/probe.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace neumann::known {

void lecture_circle(Figures& figures, std::uint64_t seed) {
    const Vec3 center(1930.420, 1973.505, 0.0);
    const double distance = glm::length(center);
    const Vec3 towards = center / distance, exact = towards * (distance - 1.0);
    for (const bool round : {true, false}) {
        SceneMaker maker;
        if (round)
            maker.add(Sphere{center, 1.0, false}, matte(0.5));
        else
            maker.add(Cylinder{center - Vec3(0, 0, 3), {0, 0, 1}, 6.0, 1.0, false}, matte(0.5));
        // This patch makes the scene as large as its coordinates.
        maker.add(patch({-1, -1, 0}, towards, 0.1), black());
        maker.parts.lights.delta = {PointLight({0, 0, 0}, grey(1.0))};
        const Scene scene = maker.make();
        const char* name = round ? "sphere" : "cylinder";
        SurfacePoint p;
        if (!scene.geometry.first_hit({0, 0, 0}, towards, 1e9, p)) return figures.fail("intersection", "the ray missed");
        figures.near(fmt::format("x of the intersection, {}", name), p.position.x, exact.x, 4 * eps * distance);
        figures.near(fmt::format("y of the intersection, {}", name), p.position.y, exact.y, 4 * eps * distance);
        // Other rays: how far from the surface they end, and whether the light is visible there, as it must be on this side.
        Sampler random(seed, 0);
        random.start(0);
        double worst = 0.0, worst_light = 0.0;
        int hidden = 0, missed = 0;
        for (int k = 0; k < 4096; ++k) {
            const Vec3 aim = center + Vec3(1.4 * random.next() - 0.7, 1.4 * random.next() - 0.7, 1.4 * random.next() - 0.7);
            SurfacePoint hit;
            if (!scene.geometry.first_hit({0, 0, 0}, glm::normalize(aim), 1e9, hit)) {
                ++missed;
                continue;
            }
            const Vec3 from_center = hit.position - center;
            worst = std::max(worst, std::abs((round ? glm::length(from_center) : std::hypot(from_center.x, from_center.y)) - 1.0));
            const double d = glm::length(hit.position), cosine = -glm::dot(hit.normal, hit.position) / d;
            if (cosine < 1e-3) continue;
            const Start start{hit, hit.normal};
            const Statistic lit =
                probe(scene, [start](Random&) { return start; }, Technique::mis, {.samples = 1, .bounces = 1, .seed = seed})
                    .terms[1];
            hidden += lit.mean.r == 0.0;
            worst_light = std::max(worst_light, std::abs(lit.mean.r * pi * d * d / (0.5 * cosine) - 1.0));
        }
        figures.near(fmt::format("largest distance from the surface, {}", name), worst, 0.0, 8 * eps * distance);
        figures.near(fmt::format("points in a wrong shadow, {}", name), hidden, 0, 0);
        figures.near(fmt::format("largest relative error of K Le, {}", name), worst_light, 0.0, 1e-11);
    }
}

}  // namespace neumann::known
