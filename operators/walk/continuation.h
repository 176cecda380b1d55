// How a walk goes on: the direction of its next reflection, and with which density it draws it. Each is a class with
//
//     Place                       what place(x, wo, wanted) finds out about a vertex; asked of all walks before any reflection, so
//                                 that nothing waits for memory; `wanted`: bounces after this one that have pictures
//     at(side, place)             what is below, for a vertex
//     sample(side, wo, sampler)   wi in the frame of side.p, its weight fs |cosθ| / density, and its pdf; pdf 0 ends the walk
//     pdf(side, wo, wi, y)        the same pdf, by which multiple importance sampling weighs lights: the density, per solid angle,
//                                 with which sample() draws wi and the walk then finds y, or one that stands for it
//     joins_points                sample() has one argument more, into which it writes the next vertex, and T is asked whether
//                                 that is seen; otherwise T looks for it along wi
//
// The pdf of a mirror is delta_pdf: light that is found by it counts in full.
#pragma once

#include "core/geometry/area_sampler.h"
#include "core/material/materials.h"
#include "operators/walk/walker.h"

#include <type_traits>
#include <vector>

namespace neumann {

// Of continuations that are the same everywhere.
struct Nowhere {};

// What a continuation has found out about the vertices of some walks.
template <class Continuation>
class Places {
public:
    using Place = typename Continuation::Place;

    explicit Places(std::size_t walks) : place_(any ? walks : 0) {}

    void find(const Continuation& continuation, const Together<Walker>& walks, int wanted) {
        if constexpr (any)
            for (const std::uint32_t i : walks.alive) place_[i] = continuation.place(walks.walker[i].x, walks.walker[i].wo, wanted);
    }
    Place operator[](std::size_t walk) const {
        if constexpr (any)
            return place_[walk];
        else
            return {};
    }

private:
    static constexpr bool any = !std::is_empty_v<Place>;
    std::vector<Place> place_;
};

// By the material.
struct MaterialContinuation {
    static constexpr bool joins_points = false;
    using Place = Nowhere;
    const MaterialContinuation& at(const SurfaceSide&, Place) const { return *this; }

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
        return neumann::sample(*side.bsdf, side.p, wo, sampler.next2());
    }
    double pdf(const SurfaceSide& side, const Vec3& wo, const Vec3& wi, const SurfacePoint&) const {
        return neumann::pdf(*side.bsdf, side.p, wo, wi);
    }
};

// By points on all surfaces, uniform by area, of which those that are not seen end the walk (Dutré, surface sampling). Deltas are
// missing, for no point falls into their direction. The variance is infinite where surfaces meet, as that of 1/d².
class SurfaceContinuation {
public:
    static constexpr bool joins_points = true;
    using Place = Nowhere;
    const SurfaceContinuation& at(const SurfaceSide&, Place) const { return *this; }

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

// By mirrors, glass and other deltas alone; other directions end the walk, whose last reflection has asked for its light: classic
// ray tracing (Whitted, An Improved Illumination Model for Shaded Display, 1980). These are some of all paths, so the terms are too
// small.
struct SpecularContinuation {
    static constexpr bool joins_points = false;
    using Place = Nowhere;
    const SpecularContinuation& at(const SurfaceSide&, Place) const { return *this; }

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
        const BsdfSample sampled = neumann::sample(*side.bsdf, side.p, wo, sampler.next2());
        return sampled.pdf == delta_pdf ? sampled : BsdfSample{};
    }
    double pdf(const SurfaceSide&, const Vec3&, const Vec3&, const SurfacePoint&) const { return 0.0; }
};

}  // namespace neumann
