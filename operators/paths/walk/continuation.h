// The continuation of a walk: how the direction of its next reflection is drawn, and with which density. Each is a class with
//
//     VertexData                  the result of vertex_data(x, wo, wanted) for a vertex, found for all walks before any
//                                 reflection to hide the latency of memory; `wanted` is the number of later bounces
//                                 that have pictures
//     at(side, data)              an object for this vertex with the two functions below
//     sample(side, wo, sampler)   wi in the frame of side.p, its weight fs |cosθ| / density, and its pdf; pdf 0 ends the walk
//     pdf(side, wo, wi, y)        the same pdf, for the weights of multiple importance sampling: the density, per solid
//                                 angle, with which sample() draws wi and the walk then finds y, or a density used in
//                                 its place
//     joins_points                if true, sample() writes the next vertex into one more argument, and a visibility ray
//                                 is cast to it; otherwise the next vertex is the first hit along wi
//
// The pdf of a mirror is delta_pdf: light that is found by it has MIS weight 1.
#pragma once

#include "core/geometry/area_sampler.h"
#include "core/material/materials.h"
#include "operators/paths/walk/walker.h"

#include <type_traits>
#include <vector>

namespace neumann {

// The VertexData of continuations that do not depend on the vertex.
struct NoVertexData {};

// The VertexData of the vertices of some walks.
template <class Continuation>
class VertexDataOfWalks {
public:
    using VertexData = typename Continuation::VertexData;

    explicit VertexDataOfWalks(std::size_t walks) : data_(any ? walks : 0) {}

    void find(const Continuation& continuation, const Together<Walker>& walks, int wanted) {
        if constexpr (any)
            for (const std::uint32_t i : walks.alive)
                data_[i] = continuation.vertex_data(walks.walker[i].x, walks.walker[i].wo, wanted);
    }
    VertexData operator[](std::size_t walk) const {
        if constexpr (any)
            return data_[walk];
        else
            return {};
    }

private:
    static constexpr bool any = !std::is_empty_v<VertexData>;
    std::vector<VertexData> data_;
};

// The continuation that samples the BSDF.
struct MaterialContinuation {
    static constexpr bool joins_points = false;
    using VertexData = NoVertexData;
    const MaterialContinuation& at(const SurfaceSide&, VertexData) const { return *this; }

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
        return neumann::sample(*side.bsdf, side.p, wo, sampler.next2());
    }
    double pdf(const SurfaceSide& side, const Vec3& wo, const Vec3& wi, const SurfacePoint&) const {
        return neumann::pdf(*side.bsdf, side.p, wo, wi);
    }
};

// The continuation that samples the next vertex uniformly by area on all surfaces; a vertex that is not visible ends
// the walk (Dutré, surface sampling). Delta lobes are missing, as a point lies in their direction with probability 0.
// The variance is infinite where surfaces meet, because the weight grows as 1/d².
class SurfaceContinuation {
public:
    static constexpr bool joins_points = true;
    using VertexData = NoVertexData;
    const SurfaceContinuation& at(const SurfaceSide&, VertexData) const { return *this; }

    explicit SurfaceContinuation(const Geometry& geometry) : surfaces_(geometry) {}

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler, SurfacePoint& next) const {
        const double choice = sampler.next();
        next = surfaces_.sample(choice, sampler.next2());
        BsdfSample sampled;
        sampled.wi = side.p.frame.to_local(glm::normalize(next.position - side.p.position));
        sampled.pdf = pdf(side, wo, sampled.wi, next);
        if (!(std::isfinite(sampled.pdf) && sampled.pdf > 0.0)) return {};
        sampled.weight = eval(*side.bsdf, side.p, wo, sampled.wi) * (std::abs(sampled.wi.z) / sampled.pdf);
        return sampled;
    }
    double pdf(const SurfaceSide& side, const Vec3&, const Vec3& wi, const SurfacePoint& y) const {
        if (y.is_infinite()) return 0.0;
        const Vec3 d = y.position - side.p.position;
        return glm::dot(d, d) / (std::abs(glm::dot(y.normal, side.p.frame.to_world(wi))) * surfaces_.area());
    }

private:
    AreaSampler surfaces_;
};

// The continuation that samples only delta lobes (mirrors, glass): classic ray tracing (Whitted, An Improved
// Illumination Model for Shaded Display, 1980). A walk ends at its first other reflection, which has still sampled the
// lights. Paths with several such reflections are missing, so the terms are too small.
struct SpecularContinuation {
    static constexpr bool joins_points = false;
    using VertexData = NoVertexData;
    const SpecularContinuation& at(const SurfaceSide&, VertexData) const { return *this; }

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
        const BsdfSample sampled = neumann::sample(*side.bsdf, side.p, wo, sampler.next2());
        return sampled.pdf == delta_pdf ? sampled : BsdfSample{};
    }
    double pdf(const SurfaceSide&, const Vec3&, const Vec3&, const SurfacePoint&) const { return 0.0; }
};

}  // namespace neumann
