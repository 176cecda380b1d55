// The rays that a walk casts, taken down to be cast again by Embree alone.
#pragma once

#include "core/geometry/geometry.h"

#include <vector>

namespace neumann {

// As Embree sees it.
struct BareRay {
    float origin[3], direction[3], length;
    bool any_hit;  // occlusion only
};

// What a double-precision caller asks of Geometry.
struct GeometryQuery {
    SurfacePoint from, to;  // `to` where visibility is asked for
    Vec3 direction;
    double length;
    enum class Kind { camera, surface, visibility } kind;
};

// Stands in for Geometry in walk().
class RecordingTransport {
public:
    explicit RecordingTransport(const Geometry& geometry) : geometry_(geometry) {}

    bool first_hit(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const;
    bool visible(const SurfacePoint& x, const SurfacePoint& y) const;
    template <class HitAt>
    std::uint32_t first_hits(std::span<const Ray> rays, const HitAt& hit) const {
        for (const Ray& ray : rays) record_camera(ray);
        return geometry_.first_hits(rays, hit);
    }
    template <class PairAt>
    std::uint32_t visible(std::size_t n, const PairAt& pair) const {
        for (std::size_t i = 0; i < n; ++i) record_visibility(pair(i).first, pair(i).second);
        return geometry_.visible(n, pair);
    }

    mutable std::vector<BareRay> bare;
    mutable std::vector<GeometryQuery> queries;

private:
    void record_camera(const Ray& ray) const;
    void record_visibility(const SurfacePoint& x, const SurfacePoint& y) const;
    void record(const Vec3& origin, const Vec3& direction, double length, bool any_hit) const;
    const Geometry& geometry_;
};

// Casts rays [begin, end) one by one with Embree and nothing else; returns the number of hits.
std::size_t cast_bare(const Geometry& geometry, const std::vector<BareRay>& rays, std::size_t begin, std::size_t end);

}  // namespace neumann
