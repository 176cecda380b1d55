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

    std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction, double length) const;
    std::optional<SurfacePoint> first_hit(const SurfacePoint& from, const Vec3& direction) const;
    bool visible(const SurfacePoint& x, const SurfacePoint& y) const;

    mutable std::vector<BareRay> bare;
    mutable std::vector<GeometryQuery> queries;

private:
    void record(const Vec3& origin, const Vec3& direction, double length, bool any_hit) const;
    const Geometry& geometry_;
};

// Casts rays [begin, end) one by one with Embree and nothing else; returns the number of hits.
std::size_t cast_bare(const Geometry& geometry, const std::vector<BareRay>& rays, std::size_t begin, std::size_t end);

}  // namespace neumann
