// A walk from the camera on its way, and those that advance together.
#pragma once

#include "operators/walk/path_end.h"
#include "operators/walk/together.h"

#include <vector>

namespace neumann {

// What a walk asks at a vertex: is y seen, or what is seen along w?
struct AskedLight {
    SurfacePoint y;
    Vec3 w;
    Rgb value;  // what y brings if it is seen, or the weight of what is seen along w; black where there is nothing to ask
};

struct Walker : PathEnd {
    static constexpr bool from_light = false;
    Vec3 wo;                 // towards the vertex before
    Vec3 from;               // that vertex
    double reflected = 0.0;  // largest channel of the last reflection's weight
    AskedLight asked;
};

// Work space of walk(), kept between calls.
struct Walkers : Together<Walker> {
    std::vector<std::uint32_t> asking;  // those that wait for an answer
    std::vector<SurfacePoint> next;     // of a continuation that joins points: the next vertex of each

    // For advance(): T, where that vertex is seen.
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
