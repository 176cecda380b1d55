// The edges that connect a vertex of the camera subpath to the light subpath, with their MIS weights and what they
// contribute if they are visible.
#pragma once

#include "operators/paths/light/light_walk.h"
#include "operators/paths/walk/shadow_rays.h"

namespace neumann {

// A contribution of way (s, t), t = bounce + 2 − s.
struct WayContribution {
    int bounce = 0, s = 0;
    Rgb value{0.0};  // without the MIS weight
    double weight = 0.0;
};

// The state of a camera subpath.
struct CameraWalker : PathEnd {
    static constexpr bool from_light = false;
    Vec3 wo;    // towards the previous vertex
    Vec3 from;  // position of the previous vertex
    PathWeights weights;
};

struct JoiningEdge {
    SurfacePoint y;
    WayContribution found;
};

// The edge of way (1, t): z samples the lights. `rest` means that the bounce is beyond N, where ways with s ≥ 2 are not used.
inline JoiningEdge edge_to_light(const Scene& scene, const EmissionSampler& emission, const LightSampler& lights, Heuristic h,
                                 const CameraWalker& z, const SurfaceSide& side, int bounce, bool rest, const Vec2& u) {
    const LightSample light = lights.sample(z.x.position, u);
    if (!(light.pdf > 0.0) || is_black(light.weight)) return {};
    const Vec3 wo = side.p.frame.to_local(z.wo), wi = side.p.frame.to_local(light.w);
    const Rgb value = reflected_light(z.beta, side, wo, wi, light.weight) * std::abs(wi.z);
    if (is_black(value)) return {};
    const bool delta = light.pdf == delta_pdf;
    const double pdf_of_sample = delta ? light.probability : light.pdf;
    double others = delta ? 0.0 : counted(h, pdf(*side.bsdf, side.p, wo, wi) / pdf_of_sample);
    if (!rest) {
        const double density =
            delta ? emission.density_of_delta(light.distant, z.x.position, light.w) : emission.density(light.point, light.w);
        others += z.weights.sum(h, density * std::abs(glm::dot(z.x.normal, light.w)) / pdf_of_sample,
                                light_pdf(scene.materials, z.x, light.w, z.wo));
    }
    const double weight = 1.0 / (1.0 + others);
    return {light.point, {bounce, 1, value, weight}};
}

// The edge of way (s, t), s ≥ 2: z is connected to the light vertex y. `bounce` counts the reflections of the camera
// subpath, including that at z.
inline JoiningEdge edge_to_vertex(const Scene& scene, Heuristic h, const CameraWalker& z, const SurfaceSide& side,
                                  const LightVertex& y, int bounce, int s) {
    const Vec3 d = y.x.position - z.x.position;
    const double distance2 = glm::dot(d, d);
    if (!(distance2 > 0.0)) return {};
    const Vec3 w = d / std::sqrt(distance2);
    const Vec3 wo = side.p.frame.to_local(z.wo), wi = side.p.frame.to_local(w);
    const Rgb f = eval(*side.bsdf, side.p, wo, wi);
    if (is_black(f)) return {};
    const SurfaceSide at_y = scene.materials.side(y.x, -w);
    if (!at_y.bsdf) return {};
    const Rgb g = geometric_bsdf(at_y, -w, y.wi);
    if (is_black(g)) return {};
    const double cosine_y = std::abs(glm::dot(y.x.normal, w)), cosine_z = std::abs(glm::dot(z.x.normal, w));
    const Rgb value = z.beta * f * g * y.beta * (std::abs(wi.z) * cosine_y / distance2);
    // The densities from the camera to y and from the light to z, and those of the reverse directions at both.
    const double to_y = pdf(*side.bsdf, side.p, wo, wi) * cosine_y / distance2;
    const double to_z = light_pdf(scene.materials, y.x, y.wi, -w) * cosine_z / distance2;
    const double back_y = pdf(*at_y.bsdf, at_y.p, at_y.p.frame.to_local(-w), at_y.p.frame.to_local(y.wi));
    const double back_z = light_pdf(scene.materials, z.x, w, z.wo);
    const double weight = 1.0 / (1.0 + y.weights.sum(h, to_y, back_y) + z.weights.sum(h, to_z, back_z));
    return {y.x, {bounce + s - 1, s, value, weight}};
}

}  // namespace neumann
