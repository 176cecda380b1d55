#include "recorded_rays.h"

#include "core/geometry/ray_caster.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace neumann {

void RecordingTransport::record(const Vec3& origin, const Vec3& direction, double length, bool any_hit) const {
    BareRay ray{};
    for (int i = 0; i < 3; ++i) {
        ray.origin[i] = static_cast<float>(origin[i]);
        ray.direction[i] = static_cast<float>(direction[i]);
    }
    ray.length = static_cast<float>(length);
    ray.any_hit = any_hit;
    bare.push_back(ray);
}

void RecordingTransport::record_hit(const Vec3& origin, const GeometryQuery& query) const {
    const RayCaster& caster = geometry_.caster();
    record(caster.to_embree(origin), query.ray.direction, query.ray.length * caster.scale(), false);
    queries.push_back(query);
}

void RecordingTransport::record_visibility(const SurfacePoint& x, const SurfacePoint& y) const {
    const RayCaster& caster = geometry_.caster();
    const Vec3 d = y.position - x.position;
    const Vec3 from = caster.to_embree(Geometry::leave(x, glm::dot(x.normal, d)));
    record(from, caster.to_embree(Geometry::leave(y, -glm::dot(y.normal, d))) - from, 1.0, true);
    queries.push_back({x, y, {}});
}

std::size_t cast_bare(const Geometry& geometry, const std::vector<BareRay>& rays, std::size_t begin, std::size_t end) {
    RTCScene scene = geometry.caster().embree_scene();
    std::size_t hits = 0;
#if RTC_VERSION_MAJOR < 4
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
#endif
    for (std::size_t i = begin; i < end; ++i) {
        const BareRay& r = rays[i];
        RTCRayHit query;
        query.ray = {r.origin[0], r.origin[1], r.origin[2], 0.0f, r.direction[0], r.direction[1], r.direction[2], 0.0f,
                     r.length,    ~0u,         0,           0};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        r.any_hit ? rtcOccluded1(scene, &query.ray, nullptr) : rtcIntersect1(scene, &query, nullptr);
#else
        r.any_hit ? rtcOccluded1(scene, &context, &query.ray) : rtcIntersect1(scene, &context, &query);
#endif
        hits += r.any_hit ? query.ray.tfar < 0.0f : query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

}  // namespace neumann
