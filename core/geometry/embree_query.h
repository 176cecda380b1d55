// The two versions of Embree's interface with which neumann is built, as one: a query, the faces that it leaves out or
// passes through, and the calls that trace it.
#pragma once

#include "core/geometry/face.h"
#include "core/geometry/ray_caster.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <span>
#include <vector>

namespace neumann::embree {

// The query context, which begins with Embree's part: the sorted faces to skip, and the list of the faces through which
// the ray passes, with the most that it may pass.
#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
inline void init(EmbreeContext& context) { rtcInitRayQueryContext(&context); }
#else
using EmbreeContext = RTCIntersectContext;
inline void init(EmbreeContext& context) { rtcInitIntersectContext(&context); }
#endif
struct Query : EmbreeContext {
    std::span<const Face> without;
    std::vector<Face>* passed = nullptr;
    std::size_t most = 0;

    explicit Query(std::span<const Face> faces = {}) : without(faces) { init(*this); }
    bool filters() const { return !without.empty() || passed; }
    bool leaves_out(std::uint32_t shape, std::uint32_t primitive) const {
        return !without.empty() && std::binary_search(without.begin(), without.end(), Face{shape, primitive});
    }
    // Whether the ray goes on behind the face, which it has hit.
    bool passes(std::uint32_t shape, std::uint32_t primitive) const {
        if (leaves_out(shape, primitive)) return true;
        if (!passed) return false;
        passed->push_back({shape, primitive});
        return passed->size() < most;
    }
};

// The number of the shape that Embree has hit: that of the instance, if it is one.
inline std::uint32_t shape_of(std::uint32_t instance, std::uint32_t geometry) {
    return instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance;
}

inline void filter(const RTCFilterFunctionNArguments* args) {
    const auto* query = static_cast<const Query*>(args->context);
    const unsigned N = args->N;
    for (unsigned i = 0; i < N; ++i) {
        const std::uint32_t shape = shape_of(RTCHitN_instID(args->hit, N, i, 0), RTCHitN_geomID(args->hit, N, i));
        if (args->valid[i] && query->passes(shape, RTCHitN_primID(args->hit, N, i))) args->valid[i] = 0;
    }
}

#if RTC_VERSION_MAJOR >= 4
constexpr RTCSceneFlags filters_allowed = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
template <class Arguments>
inline void configure(Query& query, RayCaster::Rays kind, Arguments& arguments) {
    arguments.context = &query;
    arguments.flags = kind == RayCaster::Rays::alike ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    if (!query.filters()) return;
    arguments.filter = filter;
    arguments.flags = static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
}
inline RTCIntersectArguments to_intersect(Query& query, RayCaster::Rays kind) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    configure(query, kind, arguments);
    return arguments;
}
inline RTCOccludedArguments to_occlude(Query& query, RayCaster::Rays kind) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    configure(query, kind, arguments);
    return arguments;
}
inline void trace(RTCScene scene, RTCRayHit& ray, Query query) {
    auto arguments = to_intersect(query, RayCaster::Rays::any);
    rtcIntersect1(scene, &ray, &arguments);
}
inline void trace(RTCScene scene, RTCRay& ray, Query query) {
    auto arguments = to_occlude(query, RayCaster::Rays::any);
    rtcOccluded1(scene, &ray, &arguments);
}
inline void trace(const int* valid, RTCScene scene, RTCRayHit8& rays, RayCaster::Rays kind) {
    Query query;
    auto arguments = to_intersect(query, kind);
    rtcIntersect8(valid, scene, &rays, &arguments);
}
inline void trace(const int* valid, RTCScene scene, RTCRay8& rays, RayCaster::Rays kind) {
    Query query;
    auto arguments = to_occlude(query, kind);
    rtcOccluded8(valid, scene, &rays, &arguments);
}
#else
constexpr RTCSceneFlags filters_allowed = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
inline Query& prepared(Query& query, RayCaster::Rays kind = RayCaster::Rays::any) {
    if (kind == RayCaster::Rays::alike) query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (query.filters()) query.filter = filter;
    return query;
}
inline void trace(RTCScene scene, RTCRayHit& ray, Query query) { rtcIntersect1(scene, &prepared(query), &ray); }
inline void trace(RTCScene scene, RTCRay& ray, Query query) { rtcOccluded1(scene, &prepared(query), &ray); }
inline void trace(const int* valid, RTCScene scene, RTCRayHit8& rays, RayCaster::Rays kind) {
    Query query;
    rtcIntersect8(valid, scene, &prepared(query, kind), &rays);
}
inline void trace(const int* valid, RTCScene scene, RTCRay8& rays, RayCaster::Rays kind) {
    Query query;
    rtcOccluded8(valid, scene, &prepared(query, kind), &rays);
}
#endif

}  // namespace neumann::embree
