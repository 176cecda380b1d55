// Where things are: the shapes of a scene, and the two questions that light transport asks of them, tr(p, ω) and V(x, y).
// Nothing here knows what surfaces are made of.
//
// Embree sees the scene in floats, moved to the origin and scaled by a power of two to about unit size; everything outside stays
// in scene units and double. Hits are put back onto the double geometry, and rays leave a surface from a point moved along its
// normal by the rounding error of the hit, so scale and place of the scene do not matter.
#pragma once

#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace neumann {

class RayCaster;

class Geometry {
public:
    // Degenerate triangles, and spheres and discs without extent, are left out and counted. Throws InputError where a coordinate
    // is not finite or an index is out of range.
    explicit Geometry(std::vector<Shape> shapes);
    Geometry(Geometry&&) noexcept;
    ~Geometry();

    const std::vector<Shape>& shapes() const { return shapes_; }
    std::size_t degenerate_count() const { return degenerate_count_; }

    // tr(p, ω) from a point in space, up to `distance`; ω unit length.
    std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction,
                                          double distance = std::numeric_limits<double>::infinity()) const;
    // tr(p, ω) from a surface: the first surface point seen from p along ω, on the side of p that ω points to.
    std::optional<SurfacePoint> first_hit(const SurfacePoint& from, const Vec3& direction) const;
    // V(x, y): nothing stands between two surface points.
    bool visible(const SurfacePoint& x, const SurfacePoint& y) const;

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

    const RayCaster& caster() const;

private:
    struct Embree;
    std::vector<Shape> shapes_;
    std::size_t degenerate_count_ = 0;
    Vec3 center_{0.0};
    double radius_ = 0.0;
    std::unique_ptr<Embree> embree_;
};

}  // namespace neumann
