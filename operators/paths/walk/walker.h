// The state of a walk from the camera, and of walks that advance together.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/scene/receiver.h"
#include "operators/paths/walk/path_end.h"
#include "operators/paths/walk/together.h"

#include <vector>

namespace neumann {

// The light sample of a walk before its ray is cast: to y, or along w.
struct ShadowRay {
    SurfacePoint y;
    Vec3 w;
    Rgb value;  // the contribution if y is seen, or the weight of the Le seen along w; black if no ray is needed
};

struct Walker : PathEnd {
    static constexpr bool from_light = false;
    Vec3 wo;                 // towards the previous vertex
    Receiver from;           // the previous vertex
    double reflected = 0.0;  // largest channel of the last reflection's weight
    ShadowRay shadow_ray;

    // Leaves the vertex in the direction that R has sampled.
    void leave(const SurfaceSide& side, const BsdfSample& sampled) {
        beta *= sampled.weight;
        reflected = max_component(sampled.weight);
        pdf = sampled.pdf;
        w = side.p.frame.to_world(sampled.wi);
        from = receiver(side);
    }
};

// The work space of walk(), kept between calls.
struct Walkers : Together<Walker> {
    std::vector<std::uint32_t> with_shadow_ray;  // walks whose light sample needs a ray
    std::vector<SurfacePoint> next;              // the next vertex of each walk, if the continuation joins points

    // A `find_next` for advance() that moves walks to their `next` vertices if these are visible.
    template <class Transport, class HitAt>
    std::uint32_t join_next(const Transport& T, std::size_t k, std::size_t n, const HitAt& hit) const {
        const std::uint32_t seen = T.visible(
            n,
            [&](std::size_t j) {
                const std::uint32_t i = alive[k + j];
                return std::pair<const SurfacePoint&, const SurfacePoint&>(walker[i].x, next[i]);
            },
            RayCaster::Rays::any);
        for (std::size_t j = 0; j < n; ++j)
            if (seen >> j & 1u) hit(j) = next[alive[k + j]];
        return seen;
    }
};

}  // namespace neumann
