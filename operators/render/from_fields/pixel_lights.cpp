#include "operators/render/from_fields/pixel_lights.h"

#include "core/base/hot.h"
#include "core/sampling/heuristic.h"

#include <algorithm>
#include <limits>

namespace neumann {

PixelLights::PixelLights(const Scene& scene, std::size_t last_bounce)
    : scene_(scene), last_bounce_(last_bounce), lights_(scene.geometry, scene.emitters) {
    if (scene.emitters.empty()) return;
    if (scene.emitters.has_environment()) {
        near_ = std::numeric_limits<double>::infinity();
        return;
    }
    const SobolPoints points(256);
    Sampler sampler(points, 0, 0);
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sampler.start(i);
        const LightSample light = lights_.sample(scene.geometry.center(), sampler.next2());
        if (light.pdf == delta_pdf) continue;
        low = glm::min(low, light.point.position);
        high = glm::max(high, light.point.position);
    }
    if (low.x > high.x) return;  // no light has an extent
    low_ = low;
    high_ = high;
    near_ = glm::length(high_ - low_);
}

std::uint64_t PixelLights::find(std::span<PixelRay> rays) const { return find_by_points(rays) + find_by_chance(rays); }

std::uint64_t PixelLights::find_by_points(std::span<PixelRay> rays) const {
    if (lights_.empty()) return 0;
    std::vector<PixelRay*> active;
    for (PixelRay& l : rays)
        if (sample_light(l, *l.sample->sampler, Rgb(l.sample->weight), samples_directions(l))) active.push_back(&l);
    add_visible(active);
    return active.size();
}

std::uint64_t PixelLights::find_at_links(std::span<PixelRay* const> rays) const {
    if (lights_.empty()) return 0;
    std::vector<PixelRay*> active;
    for (PixelRay* l : rays)
        if (sample_light(*l, *l->sample->gather_sampler, l->through / (l->index * l->index), true)) active.push_back(l);
    add_visible(active);
    return active.size();
}

// Chooses a point on a light and sets y and the weight of its contribution; false if it contributes nothing.
bool PixelLights::sample_light(PixelRay& l, Sampler& sampler, const Rgb& scale, bool with_directions) const {
    const LightSample light = lights_.sample(l.x.position, sampler.next2());
    if (!(light.pdf > 0.0)) return false;
    const SurfaceSide side = scene_.materials.side(l.x, l.wo);
    if (!side.bsdf) return false;
    const Vec3 wo = side.p.frame.to_local(l.wo), wi = side.p.frame.to_local(light.w);
    const double pdf_other = with_directions ? neumann::pdf(*side.bsdf, side.p, wo, wi) : 0.0;
    l.weight = eval(*side.bsdf, side.p, wo, wi) * light.weight * scale * (std::abs(wi.z) * power_heuristic(light.pdf, pdf_other));
    l.y = light.point;
    return !is_black(l.weight);
}

// Casts the shadow rays and adds the light that is visible.
void PixelLights::add_visible(std::span<PixelRay* const> active) const {
    constexpr std::size_t packet = RayCaster::packet_size;
    for (std::size_t begin = 0; begin < active.size(); begin += packet) {
        const std::size_t n = std::min(packet, active.size() - begin);
        const std::uint32_t seen = scene_.geometry.visible(
            n,
            [&](std::size_t i) {
                return std::pair<const SurfacePoint&, const SurfacePoint&>(active[begin + i]->x, active[begin + i]->y);
            },
            RayCaster::Rays::alike);
        for (std::size_t i = 0; i < n; ++i)
            if (seen >> i & 1u) active[begin + i]->sample->add(bounce_of(*active[begin + i]), active[begin + i]->weight);
    }
}

std::uint64_t PixelLights::find_by_chance(std::span<PixelRay> rays) const {
    const Emitters& emitters = scene_.emitters;
    std::vector<PixelRay*> active;
    for (PixelRay& l : rays) {
        // The other rays find light when they take all directions.
        if (!emitters.empty() && !l.takes_all && samples_directions(l) && l.choose_direction(scene_.materials, *l.sample->sampler))
            active.push_back(&l);
    }
    for_hits(
        scene_.geometry, active.size(),
        [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(active[i]->x, active[i]->wi); },
        [&](std::size_t i) -> SurfacePoint& { return active[i]->y; },
        [&](std::size_t i) {
            const PixelRay& l = *active[i];
            const Rgb emitted = emitters.emitted(l.y, -l.wi);
            if (is_black(emitted)) return;
            l.sample->add(1, l.weight * emitted *
                                 (l.sample->weight * power_heuristic(l.pdf, lights_.pdf(l.x.position, l.wi, l.y)) /
                                  (l.index_beyond * l.index_beyond)));
        });
    return active.size();
}

// Whether directions from the BSDF are used as well: near the lights (closer than the size of their box), where the
// variance of points on them may be infinite, and if the material is not diffuse. The choice depends on x alone, so the
// estimate stays unbiased.
bool PixelLights::samples_directions(const PixelRay& l) const {
    return !l.diffuse || glm::distance(l.x.position, glm::clamp(l.x.position, low_, high_)) < near_;
}

}  // namespace neumann
