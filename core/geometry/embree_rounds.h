// Spheres, discs and cylinders for Embree, which asks where its rays meet them. Coordinates are Embree's; distances are
// computed in double.
#pragma once

#include "core/base/vec.h"
#include "core/geometry/embree_query.h"

#include <cmath>
#include <limits>

namespace neumann::embree {

constexpr float infinity = std::numeric_limits<float>::infinity();

inline Vec3 origin(const RTCRay& ray) { return {ray.org_x, ray.org_y, ray.org_z}; }
inline Vec3 direction(const RTCRay& ray) { return {ray.dir_x, ray.dir_y, ray.dir_z}; }

struct SphereData {
    Vec3 center;
    double radius;
    RTCBounds bounds;

    // Smallest root in (tnear, tfar), or NaN. The half chord is computed from the distance of the centre to the line, which keeps
    // its digits for rays that start on the sphere.
    double intersect(const RTCRay& ray) const {
        const Vec3 d = direction(ray), f = origin(ray) - center;
        const double a = glm::dot(d, d), middle = -glm::dot(f, d) / a;
        const Vec3 nearest = f + d * middle;
        const double discriminant = radius * radius - glm::dot(nearest, nearest);
        if (!(discriminant >= 0.0)) return std::nan("");
        const double half = std::sqrt(discriminant / a);
        for (const double t : {middle - half, middle + half})
            if (t > ray.tnear && t < ray.tfar) return t;
        return std::nan("");
    }
};

struct DiskData {
    Vec3 center, normal, dual_u, dual_v;
    RTCBounds bounds;

    double intersect(const RTCRay& ray) const {
        const Vec3 d = direction(ray), f = center - origin(ray);
        const double t = glm::dot(normal, f) / glm::dot(normal, d);
        if (!(t > ray.tnear && t < ray.tfar)) return std::nan("");
        const Vec3 p = d * t - f;
        const double a = glm::dot(p, dual_u), b = glm::dot(p, dual_v);
        return a * a + b * b <= 1.0 ? t : std::nan("");
    }
};

struct CylinderData {
    Vec3 base, axis;
    double length, radius;
    RTCBounds bounds;

    // Works as the sphere's, across the axis; only roots on the cylinder count.
    double intersect(const RTCRay& ray) const {
        const Vec3 d = direction(ray), f = origin(ray) - base;
        const double d_along = glm::dot(d, axis), f_along = glm::dot(f, axis);
        const Vec3 d_across = d - axis * d_along, f_across = f - axis * f_along;
        const double a = glm::dot(d_across, d_across), middle = -glm::dot(f_across, d_across) / a;
        const Vec3 nearest = f_across + d_across * middle;
        const double discriminant = radius * radius - glm::dot(nearest, nearest);
        if (!(discriminant >= 0.0)) return std::nan("");
        const double half = std::sqrt(discriminant / a);
        for (const double t : {middle - half, middle + half}) {
            const double along = f_along + t * d_along;
            if (t > ray.tnear && t < ray.tfar && along >= 0.0 && along <= length) return t;
        }
        return std::nan("");
    }
};

// The float box around center ± extent, rounded outwards.
inline RTCBounds outward_bounds(const Vec3& center, const Vec3& extent) {
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -infinity); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), infinity); };
    const Vec3 low = center - extent, high = center + extent;
    return {down(low.x), down(low.y), down(low.z), 0.0f, up(high.x), up(high.y), up(high.z), 0.0f};
}

template <class Data>
inline void bounds_callback(const RTCBoundsFunctionArguments* args) {
    *args->bounds_o = static_cast<const Data*>(args->geometryUserPtr)->bounds;
}

template <class Data>
inline void intersect_callback(const RTCIntersectFunctionNArguments* args) {
    if (static_cast<const Query*>(args->context)->leaves_out(args->geomID, args->primID)) return;
    const unsigned N = args->N;
    RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, N);
    RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, N);
    for (unsigned i = 0; i < N; ++i) {
        if (!args->valid[i]) continue;
        const double t = static_cast<const Data*>(args->geometryUserPtr)->intersect(rtcGetRayFromRayN(rays, N, i));
        if (std::isnan(t)) continue;
        RTCRayN_tfar(rays, N, i) = static_cast<float>(t);
        RTCHitN_geomID(hits, N, i) = args->geomID;
        RTCHitN_primID(hits, N, i) = args->primID;
        RTCHitN_instID(hits, N, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
}

template <class Data>
inline void occluded_callback(const RTCOccludedFunctionNArguments* args) {
    const auto* query = static_cast<const Query*>(args->context);
    if (query->leaves_out(args->geomID, args->primID)) return;
    const unsigned N = args->N;
    for (unsigned i = 0; i < N; ++i)
        if (args->valid[i] &&
            !std::isnan(static_cast<const Data*>(args->geometryUserPtr)->intersect(rtcGetRayFromRayN(args->ray, N, i))) &&
            !query->passes(args->geomID, args->primID))
            RTCRayN_tfar(args->ray, N, i) = -infinity;
}

}  // namespace neumann::embree
