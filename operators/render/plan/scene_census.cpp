#include "operators/render/plan/scene_census.h"

#include "core/sampling/warp.h"
#include "operators/fields/matrix/sides.h"

#include <algorithm>

namespace neumann {

namespace {

bool has_mask(const Bsdf& bsdf) { return std::holds_alternative<Mask>(bsdf) || std::holds_alternative<Null>(bsdf); }

SurfacePoint far_away() {
    SurfacePoint p;
    p.shape = SurfacePoint::infinity;
    return p;
}

}  // namespace

SceneCensus::SceneCensus(const Scene& scene)
    : shapes(scene.geometry.shapes().size()),
      has_environment(scene.emitters.has_environment()),
      has_delta_lights(scene.emitters.has_delta_lights()),
      is_grey(neumann::is_grey(scene)) {
    for (std::uint32_t shape = 0; shape < shapes; ++shape) {
        bool is_smooth = has_smooth_normals(scene.geometry.shapes()[shape]);
        light_shapes += scene.emitters.powers()[shape] > 0.0;
        for (const bool front : {true, false}) {
            const Bsdf* bsdf = scene.materials.at(shape, front);
            if (!bsdf) continue;
            const Lobe::Kind kind = lobe(*bsdf).kind;
            ++sides;
            textured += !is_constant(*bsdf);
            specular += kind == Lobe::Kind::specular;
            rough += kind == Lobe::Kind::rough;
            transmissive += transmits(*bsdf);
            masked += has_mask(*bsdf);
            is_smooth = is_smooth || std::holds_alternative<PerturbedNormal>(*bsdf);
        }
        smooth += is_smooth;
    }
    const Emitters& emitters = scene.emitters;
    // The density of an environment picture has this value in both directions only by chance.
    has_constant_environment = has_environment && emitters.environment_pdf({0.0, 0.0, 1.0}) == 0.25 * inv_pi &&
                               emitters.environment_pdf({1.0, 0.0, 0.0}) == 0.25 * inv_pi;
    shines_alike = shapes > 0 && light_shapes == shapes && emitters.shapes_shine_evenly() && !has_delta_lights &&
                   (!has_environment || has_constant_environment);
    for (std::uint32_t shape = 0; shines_alike && shape < shapes; ++shape) {
        const SurfacePoint p = scene.geometry.point(shape, 0, Vec2(0.5));
        shines_alike = emitters.emitted(p, p.normal) == emitters.largest_radiance();
    }
    if (shines_alike && has_environment)
        shines_alike = emitters.emitted(far_away(), {0.0, 0.0, 1.0}) == emitters.largest_radiance();
}

}  // namespace neumann
