// Intersection in double precision, for the few rays and points where Embree's floats are too coarse.
#pragma once

#include "core/geometry/bounds.h"
#include "core/geometry/face.h"
#include "core/geometry/ray_start.h"
#include "core/geometry/shape.h"
#include "core/geometry/triangle.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

// The triangle of a face, which is made on demand for an instance; null if the face is round.
class TriangleOfFace {
public:
    TriangleOfFace(const Triangle* stored = nullptr) : stored_(stored) {}
    explicit TriangleOfFace(const Triangle& made) : made_(made) {}

    explicit operator bool() const { return stored_ || made_; }
    const Triangle& operator*() const { return made_ ? *made_ : *stored_; }
    const Triangle* operator->() const { return &**this; }

private:
    const Triangle* stored_ = nullptr;
    std::optional<Triangle> made_;
};

class DoubleFaces {
public:
    // Geometry's arrays by shape, which must outlive this object: the triangles of meshes, and the errors of other shapes.
    DoubleFaces(const std::vector<Shape>& shapes, std::span<const std::vector<Triangle>> triangles, std::span<const double> errors)
        : shapes_(&shapes), triangles_(triangles), errors_(errors) {}

    const std::vector<Shape>& shapes() const { return *shapes_; }
    TriangleOfFace triangle(const Face& f) const {
        const auto& of_shape = triangles_[f.shape];
        return of_shape.empty() ? triangle_of_instance(f) : &of_shape[f.primitive];
    }
    bool is_triangle(const Face& f) const { return !triangles_[f.shape].empty() || is_of_instance(f); }
    bool is_of_instance(const Face& f) const { return std::holds_alternative<MeshInstance>((*shapes_)[f.shape]); }
    std::array<Vec3, 3> vertices(const Face& f) const { return corners_of((*shapes_)[f.shape], f.primitive).at; }
    // How far rounding to float moves the face, and a hit on it.
    double error(const Face& f) const {
        const auto& of_shape = triangles_[f.shape];
        return of_shape.empty() ? errors_[f.shape] : of_shape[f.primitive].error();
    }
    Bounds bounds(const Face& f) const;
    // An upper bound on the size from the triangle alone, because its corners are elsewhere in memory.
    double size_at_most(const Face& f) const;
    // Prefetch what is needed next, for many faces at a time, because a fine mesh is in no cache: a triangle and the
    // numbers of its corners; then the corners.
    void prefetch(const Face& f) const {
        if (triangles_[f.shape].empty()) return;
        const char* lines = reinterpret_cast<const char*>(&triangles_[f.shape][f.primitive]);
        for (std::size_t line = 0; line < sizeof(Triangle); line += 64) __builtin_prefetch(lines + line);
        __builtin_prefetch(&std::get<TriangleMesh>((*shapes_)[f.shape]).triangles[f.primitive]);
    }
    void prefetch_corners(const Face& f) const;
    // Diameter of the sphere around the face's bounding box.
    double size(const Face& f) const { return 2.0 * bounds(f).radius(); }
    // All faces but those of instances.
    std::vector<Face> all() const;

    // Whether p is at most `distance` from the face; near corners the limit is a little larger.
    bool is_near(const Face& f, const Vec3& p, double distance) const;
    // How far p is above a face, or above the plane of a triangle or disc: on the side of its normal.
    struct Height {
        Vec3 normal;  // unit length, at the place that is nearest to p
        double distance, rounding;
        // Whether the height is 0, as far as doubles can tell.
        bool is_zero() const { return std::abs(distance) <= rounding; }
    };
    Height height(const Face& f, const Vec3& p) const;
    // Whether p lies on the face or its plane.
    bool holds(const Face& f, const Vec3& p) const { return height(f, p).is_zero(); }
    // Finds the distances > 0 at which a ray hits the face: up to two, ascending, without the start itself. Returns their number.
    // `direction`: unit length. A ray that passes an edge on the outside, by at most this many rounding errors, counts as a hit: if
    // two faces share an edge, the ray must hit at least one of them.
    int meet(const Face& f, const RayStart& start, const Vec3& direction, double (&distances)[2], double roundings = 1.0) const;
    // A ray that passes an edge by fewer rounding errors might as well be on its other side.
    static constexpr double unsure = 2.0;
    // The displacement that makes such a ray from p, which meets the face at `distance`, certainly hit the face;
    // nothing for other rays.
    std::optional<Vec3> off_edge(const Face& f, const Vec3& p, const Vec3& direction, double distance) const;

private:
    TriangleOfFace triangle_of_instance(const Face& f) const;

    const std::vector<Shape>* shapes_;
    std::span<const std::vector<Triangle>> triangles_;
    std::span<const double> errors_;
};

}  // namespace neumann
