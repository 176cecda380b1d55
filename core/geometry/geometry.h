// The shapes of a scene, and the two functions of them that light transport needs: ray tracing tr(p, ω) and visibility V(x, y).
// Materials are not known here.
//
// Embree holds the scene in floats, moved to the origin and scaled by a power of two to about unit size; everything else is in
// scene units and double. Embree only finds which primitive is hit, with a ray whose origin is offset along the normal by the
// rounding error of floats. The hit point is then computed in double, with the ray from the original point. The scale and position
// of the scene therefore do not matter. Where surfaces are closer to each other than floats can resolve, everything is done in
// double (Neighbours), and so are faces so large that they would make floats coarse for all others (Giants).
#pragma once

#include "core/geometry/ray.h"
#include "core/geometry/ray_caster.h"
#include "core/geometry/ray_start.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"
#include "core/geometry/triangle.h"
#include "core/sampling/warp.h"

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace neumann {

class Neighbours;
struct RoundPoint;

class Geometry {
public:
    // Degenerate triangles, and other shapes without extent, are left out and counted. Throws InputError if a coordinate is not
    // finite or an index is out of range.
    explicit Geometry(std::vector<Shape> shapes);
    Geometry(Geometry&&) noexcept;
    ~Geometry();

    const std::vector<Shape>& shapes() const { return *shapes_; }
    std::shared_ptr<const std::vector<Shape>> shared_shapes() const { return shapes_; }
    std::size_t degenerate_count() const { return degenerate_count_; }

    // tr(p, ω) from a point in space, up to `distance`; ω has unit length. Returns false and leaves `hit` unchanged if nothing is
    // hit.
    bool first_hit(const Vec3& origin, const Vec3& direction, double distance, SurfacePoint& hit) const;
    // tr(p, ω) from a surface: the first surface point seen from p along ω, on the side of p that ω points to. `hit` may be `from`.
    bool first_hit(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const;
    // V(x, y): whether two surface points see each other.
    bool visible(const SurfacePoint& x, const SurfacePoint& y) const;

    // The same for up to RayCaster::packet_size rays or pairs; bit i of the result is for the i-th. `from(i)` returns references to
    // the start and the direction, `pair(i)` to the two points, and `hit(i)` to the variable for the hit.
    template <class AnyRay, class HitAt>
    std::uint32_t first_hits(std::span<const AnyRay> rays, const HitAt& hit) const {
        if (!giants_.empty())
            return one_by_one(rays.size(),
                              [&](std::size_t i) { return first_hit(rays[i].origin, rays[i].direction, rays[i].length, hit(i)); });
        RayCaster::Packet packet(*caster_);
        for (const AnyRay& ray : rays) packet.add(ray.origin, ray.direction, ray.length);
        RayCaster::Hit hits[RayCaster::packet_size];
        std::uint32_t found = caster_->intersect(packet, hits, RayCaster::Rays::alike);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (found >> i & 1u && !put_on_surface(rays[i].origin, rays[i].direction, hits[i], hit(i)))
                found = (found & ~(1u << i)) |
                        static_cast<std::uint32_t>(first_hit(rays[i].origin, rays[i].direction, rays[i].length, hit(i))) << i;
        return found;
    }
    template <class FromAt, class HitAt>
    std::uint32_t first_hits(std::size_t n, const FromAt& from, const HitAt& hit) const {
        if (!giants_.empty())
            return one_by_one(n, [&](std::size_t i) {
                const auto& [x, w] = from(i);
                return first_hit(x, w, hit(i));
            });
        RayCaster::Packet packet(*caster_);
        std::uint32_t close = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto& [x, w] = from(i);
            packet.add(leave(x, glm::dot(x.normal, w)), w);
            close |= static_cast<std::uint32_t>(x.close) << i;
        }
        RayCaster::Hit hits[RayCaster::packet_size];
        std::uint32_t found = caster_->intersect(packet, hits, RayCaster::Rays::any) & ~close;
        for (std::size_t i = 0; i < n; ++i) {
            const auto& [x, w] = from(i);
            if (close >> i & 1u)
                found |= static_cast<std::uint32_t>(first_hit_in_double(x, w, hit(i))) << i;
            else if (found >> i & 1u && !put_on_surface(x, w, hits[i], hit(i)))
                found = (found & ~(1u << i)) | static_cast<std::uint32_t>(first_hit(x, w, hit(i))) << i;
        }
        return found;
    }
    // Finds hits as first_hits() does, for estimates to which it does not matter which of two surfaces is met if they are closer
    // together than floats resolve: what is near is not looked for. `from` may give bare points, and the hits are bare.
    template <class FromAt, class HitAt>
    std::uint32_t rough_hits(std::size_t n, const FromAt& from, const HitAt& hit) const {
        if (!giants_.empty()) return first_hits(n, from, hit);
        RayCaster::Packet packet(*caster_);
        for (std::size_t i = 0; i < n; ++i) {
            const auto& [x, w] = from(i);
            packet.add(leave(x, glm::dot(x.normal, w)), w);
        }
        RayCaster::Hit hits[RayCaster::packet_size];
        const std::uint32_t found = caster_->intersect(packet, hits, RayCaster::Rays::any);
        for (std::size_t i = 0; i < n; ++i)
            if (found >> i & 1u) {
                const auto& [x, w] = from(i);
                put_bare(x.position, w, hits[i], hit(i));
            }
        return found;
    }
    template <class PairAt>
    std::uint32_t visible(std::size_t n, const PairAt& pair, RayCaster::Rays kind) const {
        if (!giants_.empty())
            return one_by_one(n, [&](std::size_t i) {
                const auto& [x, y] = pair(i);
                return visible(x, y);
            });
        RayCaster::Packet packet(*caster_);
        std::uint32_t close = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto& [x, y] = pair(i);
            const Vec3 d = y.position - x.position;
            packet.add_segment(leave(x, glm::dot(x.normal, d)), leave(y, -glm::dot(y.normal, d)));
            close |= static_cast<std::uint32_t>(x.close || y.close) << i;
        }
        std::uint32_t seen = ~caster_->occluded(packet, kind) & ((1u << n) - 1u);
        for (std::size_t i = 0; close >> i != 0; ++i)
            if (close >> i & 1u) {
                const auto& [x, y] = pair(i);
                seen = (seen & ~(1u << i)) | static_cast<std::uint32_t>(visible_in_double(x, y)) << i;
            }
        return seen;
    }

    // The origin of a ray that leaves p on the side of its normal (side > 0) or on the other: offset by the hit's rounding error.
    static Vec3 leave(const SurfacePoint& p, double side) { return p.position + p.normal * std::copysign(p.error, side); }

    // For sampling uniformly by area: number of primitives of a shape, their areas, and the point at (u, v) ∈ [0,1)² of a
    // primitive.
    std::uint32_t primitive_count(std::uint32_t shape) const;
    double area(std::uint32_t shape, std::uint32_t primitive) const;
    double area(std::uint32_t shape) const;
    SurfacePoint point(std::uint32_t shape, std::uint32_t primitive, const Vec2& uv) const {
        return point(primitive_ref(shape, primitive), uv);
    }
    // The same in two steps, for a primitive that is sampled often. The reference is valid as long as the geometry.
    struct PrimitiveRef {
        std::uint32_t shape, primitive;
        const Triangle* triangle;  // null on a round shape or an instance
        Triangle::Edges edges;
    };
    PrimitiveRef primitive_ref(std::uint32_t shape, std::uint32_t primitive) const {
        if (triangles_[shape].empty()) return {shape, primitive, nullptr, {}};
        return {shape, primitive, &triangles_[shape][primitive], edges(shape, primitive)};
    }
    SurfacePoint point(const PrimitiveRef& ref, const Vec2& uv) const {
        if (!ref.triangle) return point_off_meshes(ref.shape, ref.primitive, uv);
        const Triangle& t = *ref.triangle;
        const Vec2 weights = uniform_triangle(uv);
        SurfacePoint p{t.at(weights.x, weights.y, ref.edges), t.normal(), t.error(), ref.shape, ref.primitive};
        if (!t.is_clear(weights)) look_around(p);
        return p;
    }

    // A point for which it is not determined whether it is close. look_around() does that, and moves a point that is
    // close off faces that cross its own.
    SurfacePoint bare_point(const PrimitiveRef& ref, const Vec2& uv) const;
    void look_around(SurfacePoint& p) const { look_around(p, nullptr); }
    // The first hit of a ray along the normal back to such a point, which starts `errors` times the point's error in
    // front of it and ends as far behind: the point, or a bare point of a face that lies in the same place. In a heap
    // of faces a few are compared, whatever its size.
    SurfacePoint seen_in_place_of(const SurfacePoint& p, double errors) const;

    // Moves a point near the plane of a triangle onto the triangle.
    SurfacePoint point_on_triangle(std::uint32_t shape, std::uint32_t primitive, const Vec3& position) const {
        if (triangles_[shape].empty()) return point_on_instance({shape, primitive}, position);
        const Triangle& t = triangles_[shape][primitive];
        SurfacePoint p = on_triangle(t, shape, primitive, position);
        if (!t.is_clear(t.weights(p.position))) look_around(p);
        return p;
    }
    // The inverse of point() on a sphere or a disc: the (u, v) of a point there.
    Vec2 round_coordinates(std::uint32_t shape, const Vec3& position) const;

    // The sphere around the bounding box, in scene units; radius 0 if the scene has no surfaces.
    Vec3 center() const { return center_; }
    double radius() const { return radius_; }

    const RayCaster& caster() const { return *caster_; }
    // The faces that Embree does not hold (giants.h), in order.
    const std::vector<Face>& giants() const { return giants_; }

private:
    Triangle::Edges edges(std::uint32_t shape, std::uint32_t primitive) const {
        const TriangleCorners corners = corners_of((*shapes_)[shape], primitive);
        return {corners.at[1] - corners.at[0], corners.at[2] - corners.at[0]};
    }
    static const Vec3& position(const Vec3& p) { return p; }
    template <class Start>
    static const Vec3& position(const Start& start) {
        return start.position;
    }
    // Computes the hit in double: the point p where the ray from `start`, a point in space or on a surface, hits the primitive that
    // Embree found. `start` may be p. Returns false and leaves p unchanged if other faces are close and, in double, the ray misses
    // the primitive.
    template <class Start>
    bool put_on_surface(const Start& start, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const {
        if (!triangles_[hit.shape].empty()) {
            const Triangle& t = triangles_[hit.shape][hit.primitive];
            const Triangle::Meeting m = t.meet(position(start), direction);
            if (t.is_hit(m) && t.is_clear(m.weights, m.cosine)) {
                p = {m.position, t.normal(), t.error(), hit.shape, hit.primitive};
                return true;
            }
        }
        return put_among_others(start, direction, hit, p);
    }
    void put_bare(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const {
        if (!triangles_[hit.shape].empty()) {
            const Triangle& t = triangles_[hit.shape][hit.primitive];
            const Triangle::Meeting m = t.meet(origin, direction);
            if (t.is_hit(m)) {
                p = {m.position, t.normal(), t.error(), hit.shape, hit.primitive};
                return;
            }
        }
        put_alone(origin, direction, hit, p);
    }
    bool put_among_others(const RayStart& start, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const;
    SurfacePoint hit_among_others(const RayStart& start, const Vec3& direction, const RayCaster::Hit& hit) const;
    // Computes the hit by itself, whatever else is near. Returns false if the ray passes beside the face that Embree
    // found, within Embree's rounding; then p is on its edge.
    bool put_alone(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const;
    bool put_near_edge(const Vec3& origin, const Vec3& direction, const RayCaster::Hit& hit, SurfacePoint& p) const;
    // Moves such a p to the face around it that the ray meets in double, if there is one.
    void move_beside(const RayStart& start, const Vec3& direction, SurfacePoint& p) const;
    SurfacePoint round_point(const Face& face, const RoundPoint& p) const;
    SurfacePoint on_triangle(const Triangle& t, std::uint32_t shape, std::uint32_t primitive, const Vec3& position) const {
        return {t.at(position, [&] { return edges(shape, primitive); }), t.normal(), t.error(), shape, primitive};
    }
    void look_around(SurfacePoint& p, const StartedRay* ray) const;
    // Moves p to a face close to it that is hit first, if there is one. Returns false if the ray misses p's own face.
    bool settle(const RayStart& start, const Vec3& direction, SurfacePoint& p) const;
    // The first hit after that, with the close faces in double and all others by Embree, whose ray starts at `embree_start`.
    bool first_hit_past(const RayStart& start, const Vec3& embree_start, const Vec3& direction, double distance,
                        std::vector<Face> faces, SurfacePoint& hit) const;
    SurfacePoint bare_point_on(const Face& face, const Vec3& position) const;
    SurfacePoint point_on(const Face& face, const StartedRay& ray, double distance) const;
    SurfacePoint point_on_instance(const Face& face, const Vec3& position) const;
    // Intersects the faces around close points, and giants, in double, and all others with Embree.
    bool first_hit_in_double(const SurfacePoint& from, const Vec3& direction, SurfacePoint& hit) const;
    bool visible_in_double(const SurfacePoint& x, const SurfacePoint& y) const;
    // Tests whether a giant is hit before p, which Embree found.
    bool meet_giants(const RayStart& start, const Vec3& direction, double distance, bool found, SurfacePoint& p) const;
    template <class Test>
    static std::uint32_t one_by_one(std::size_t n, const Test& test) {
        std::uint32_t found = 0;
        for (std::size_t i = 0; i < n; ++i) found |= static_cast<std::uint32_t>(test(i)) << i;
        return found;
    }
    SurfacePoint point_off_meshes(std::uint32_t shape, std::uint32_t primitive, const Vec2& uv) const;

    std::shared_ptr<const std::vector<Shape>> shapes_;
    std::size_t degenerate_count_ = 0;
    Vec3 center_{0.0};
    double radius_ = 0.0;
    std::unique_ptr<RayCaster> caster_;
    std::vector<std::vector<Triangle>> triangles_;  // by shape; empty if the shape has no mesh of its own
    std::vector<double> error_;                     // by shape, for shapes without a mesh of their own
    std::vector<Face> giants_;
    std::unique_ptr<Neighbours> neighbours_;
};

}  // namespace neumann
