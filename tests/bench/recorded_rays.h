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
    Ray ray;                // where a hit is asked for; its origin counts for camera rays only
};

// Up to RayCaster::packet_size of them, asked at once.
struct GeometryPacket {
    enum class Kind { camera, surface, visibility } kind;
    RayCaster::Rays rays;
    std::uint32_t n;
    std::size_t begin;  // in the list of queries
};

// Stands in for Geometry in walk().
class RecordingTransport {
public:
    explicit RecordingTransport(const Geometry& geometry) : geometry_(geometry) {}

    template <class AnyRay, class HitAt>
    std::uint32_t first_hits(std::span<const AnyRay> rays, const HitAt& hit) const {
        start(GeometryPacket::Kind::camera, RayCaster::Rays::alike, rays.size());
        for (const Ray& ray : rays) record_hit(ray.origin, {.from = {}, .to = {}, .ray = ray});
        return geometry_.first_hits(rays, hit);
    }
    template <class FromAt, class HitAt>
    std::uint32_t first_hits(std::size_t n, const FromAt& from, const HitAt& hit) const {
        start(GeometryPacket::Kind::surface, RayCaster::Rays::any, n);
        for (std::size_t i = 0; i < n; ++i) {
            const SurfacePoint& x = from(i).first;
            const Vec3& w = from(i).second;
            record_hit(Geometry::leave(x, glm::dot(x.normal, w)), {.from = x, .to = {}, .ray = {x.position, w}});
        }
        return geometry_.first_hits(n, from, hit);
    }
    template <class PairAt>
    std::uint32_t visible(std::size_t n, const PairAt& pair, RayCaster::Rays rays) const {
        start(GeometryPacket::Kind::visibility, rays, n);
        for (std::size_t i = 0; i < n; ++i) record_visibility(pair(i).first, pair(i).second);
        return geometry_.visible(n, pair, rays);
    }

    mutable std::vector<BareRay> bare;
    mutable std::vector<GeometryQuery> queries;
    mutable std::vector<GeometryPacket> packets;

private:
    void start(GeometryPacket::Kind kind, RayCaster::Rays rays, std::size_t n) const {
        packets.push_back({kind, rays, static_cast<std::uint32_t>(n), queries.size()});
    }
    void record_hit(const Vec3& origin, const GeometryQuery& query) const;
    void record_visibility(const SurfacePoint& x, const SurfacePoint& y) const;
    void record(const Vec3& origin, const Vec3& direction, double length, bool any_hit) const;
    const Geometry& geometry_;
};

// Casts rays [begin, end) one by one with Embree and nothing else; returns the number of hits.
std::size_t cast_bare(const Geometry& geometry, const std::vector<BareRay>& rays, std::size_t begin, std::size_t end);

}  // namespace neumann
