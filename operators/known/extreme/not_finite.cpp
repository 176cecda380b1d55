// In a picture: every sample that is no number is counted and none is painted black in silence.
#include "core/base/error.h"
#include "operators/known/extreme/groups.h"
#include "operators/known/pictures.h"
#include "operators/known/scene_maker.h"

#include <fmt/format.h>
#include <limits>

namespace neumann::known {

namespace {}  // namespace

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
        PictureSampler::Settings settings;
        settings.walk = {.bounces = 1, .direct = {DirectLight::bsdf}, .rest_probability = 0.0};
        settings.seed = seed;
        const Pictures pictures = render(maker.make(), settings, 4);
        // Two terms of 4 pixels × 4 replicates × 8 samples.
        figures.near(fmt::format("radiance {}: samples counted", number), static_cast<double>(pictures.tally.non_finite_samples()),
                     2 * 4 * 4 * 8, 0);
        figures.holds(fmt::format("radiance {}: where they were is known", number), !pictures.tally.non_finite.empty());
    }
}

}  // namespace neumann::known
