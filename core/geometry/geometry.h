// Where things are: the shapes of a scene, and the two questions that light transport asks of them, tr(p, ω) and V(x, y).
// Nothing here knows what surfaces are made of.
//
// Embree sees the scene in floats, moved to the origin and scaled by a power of two to about unit size; everything outside stays
// in scene units and double. Hits are put back onto the double geometry, and rays leave a surface from a point moved along its
// normal by the rounding error of the hit, so scale and place of the scene do not matter.
#pragma once

#include "core/geometry/ray.h"
#include "core/geometry/ray_caster.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace neumann {

class Geometry {
public:
    // Degenerate triangles, and spheres and discs without extent, are left out and counted. Throws InputError where a coordinate
    // is not finite or an index is out of range.
    explicit Geometry(std::vector<Shape> shapes);
    Geometry(Geometry&&) noexcept;
    ~Geometry();

    const std::vector<Shape>& shapes() const { return shapes_; }
    std::size_t degenerate_count() const { return degenerate_count_; }

    // tr(p, ω) from a point in space, up to `distance`; ω unit length. False where nothing is hit; `hit` is then left as it was.
    bool first_hit(const Vec3& origin, const Vec3& direction, double distance, SurfacePoint& hit) const;
    // tr(p, ω) from a surface: the first surface point seen from p along ω, on the side of p that ω points to. `hit` may be `from`.
    bool first_hit(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const {
        return first_hit(leave(from, glm::dot(from.normal, direction)), direction, std::numeric_limits<double>::infinity(), hit);
    }
    // V(x, y): nothing stands between two surface points.
    bool visible(const SurfacePoint& x, const SurfacePoint& y) const;

    // The same for up to RayCaster::packet rays or pairs that are alike, such as those of one pixel: bit i answers for the i-th. `hit(i)` and
    // `pair(i)` give references to where a hit goes and to the two points.
    template <class HitAt>
    std::uint32_t first_hits(std::span<const Ray> rays, const HitAt& hit) const {
        RayCaster::Hit hits[RayCaster::packet];
        const std::uint32_t found = caster_->intersect(rays, hits);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (found >> i & 1u) put_on_surface(rays[i].origin, rays[i].direction, hits[i], hit(i));
        return found;
    }
    template <class PairAt>
    std::uint32_t visible(std::size_t n, const PairAt& pair) const {
        Vec3 from[RayCaster::packet], to[RayCaster::packet];
        for (std::size_t i = 0; i < n; ++i) {
            const std::pair<const SurfacePoint&, const SurfacePoint&> xy = pair(i);
            const Vec3 d = xy.second.position - xy.first.position;
            from[i] = leave(xy.first, glm::dot(xy.first.normal, d));
            to[i] = leave(xy.second, -glm::dot(xy.second.normal, d));
        }
        return ~caster_->occluded(std::span<const Vec3>(from, n), std::span<const Vec3>(to, n)) & ((1u << n) - 1u);
    }

    // Where a ray starts that leaves p to the side of its normal (side > 0) or to the other: clear of the hit's rounding error.
    static Vec3 leave(const SurfacePoint& p, double side) { return p.position + p.normal * std::copysign(p.error, side); }

    // Uniform by area: number of primitives of a shape, their areas, and the point at (u, v) ∈ [0,1)² of a primitive.
    std::uint32_t primitive_count(std::uint32_t shape) const;
    double area(std::uint32_t shape, std::uint32_t primitive) const;
    double area(std::uint32_t shape) const;
    SurfacePoint point(std::uint32_t shape, std::uint32_t primitive, const Vec2& uv) const;

    // The sphere around the bounding box, scene units; radius 0 for a scene without surfaces.
    Vec3 center() const { return center_; }
    double radius() const { return radius_; }

    const RayCaster& caster() const { return *caster_; }

private:
    // A triangle with what a hit on it needs, scene units.
    struct TriangleRecord {
        Vec3 vertex, edge1, edge2, normal;
        double error;
        double margin;  // hits keep this barycentric distance from the edges, so that rounding cannot push them through a wall that
                        // meets the triangle there; 0 where the triangle is too thin for that
    };
    // A hit of Embree's, back on the double geometry.
    void put_on_surface(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const;

    std::vector<Shape> shapes_;
    std::size_t degenerate_count_ = 0;
    Vec3 center_{0.0};
    double radius_ = 0.0;
    std::unique_ptr<RayCaster> caster_;
    std::vector<std::vector<TriangleRecord>> triangles_;  // by shape; empty where the shape is no mesh
    std::vector<double> error_;                           // by shape: spheres and discs
};

}  // namespace neumann
