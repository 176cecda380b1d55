// Samples of a picture that are not finite numbers are all counted, and none becomes black silently.
#include "core/base/error.h"
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>
#include <limits>

namespace neumann::known {

void numbers_that_are_none(Figures& figures, std::uint64_t seed) {
    for (const double number : {std::numeric_limits<double>::quiet_NaN(), infinity}) {
        TriangleMesh mesh = patch({0, 0, 0}, {0, 0, 1}, 1.0);
        mesh.vertices[2].y = number;
        try {
            const Geometry geometry({mesh});
            figures.fail("a vertex that is no number", "was accepted");
        } catch (const InputError& error) {
            figures.holds(fmt::format("a vertex with {} is refused", number),
                          std::string(error.what()).find("finite") != std::string::npos);
        }
        SceneMaker maker;
        maker.add(Sphere{{0, 0, 0}, 1.0, true},
                  {grey(0.5), AreaLight([number](const SurfacePoint&, const Vec3&) { return grey(number); }, grey(1.0))});
        maker.parts.camera.fov = 1.0;
        maker.parts.film = {2, 2, 0, 0, 2, 2, BoxFilter()};
        method::Walk walk;
        walk.direct = {DirectLight::bsdf};
        const BounceSeries series = render(maker.make(), walk, {.bounces = 1, .samples = 32, .seed = seed});
        const Health& health = *std::get<PathRecord>(series.record).health;
        // All 32 samples of each of 4 pixels must be counted.
        for (const std::size_t i : {0, 1})
            figures.near(fmt::format("radiance {}: samples of K^{} Le counted", number, i),
                         static_cast<double>(health.bounces[i].non_finite), 4 * 32, 0);
        figures.holds(fmt::format("radiance {}: where they were is known", number), !health.first_non_finite.empty());
    }
}

}  // namespace neumann::known
