// A flat shape that gives off light along its normal alone (Mitsuba's `directionalarea`): a beam of parallel light with the shape's
// cross-section and, across it, the irradiance that is the shape's radiant exitance. No ray meets it along that one direction, so
// only light sampling finds it, as it finds lights without extent: from x, at the foot of the perpendicular onto the shape.
#pragma once

#include "core/emitter/area_light.h"
#include "core/emitter/beam.h"
#include "core/geometry/geometry.h"
#include "core/sampling/warp.h"

#include <memory>
#include <optional>
#include <vector>

namespace neumann {

// Whether a light can be made of the shape: a disc, or a mesh whose triangles all lie in one plane and face the same way, and so do
// its normals.
bool is_flat(const Shape& shape);

class DirectionalArea {
public:
    // Keeps no reference to the geometry, only its shapes. Throws InputError if the shape is not flat.
    DirectionalArea(const Geometry& geometry, std::uint32_t shape, AreaLight light);

    Beam beam(const Vec3& at, const Surroundings&) const;
    // The total power divided by π, with the largest exitance.
    double brightness(const Surroundings&) const { return area_ * mean_component(light_.largest) * inv_pi; }
    bool is_grey() const { return !light_.function && neumann::is_grey(light_.largest); }

    const Vec3& normal() const { return normal_; }
    // Samples a point from which light sets out, uniform by area, with density().
    Vec3 start(const Vec2& u) const;
    double density() const { return 1.0 / area_; }
    // The exitance of the shape at the foot of the perpendicular from a point.
    Rgb exitance(const Vec3& at) const;
    // Whether the beam reaches a point, were nothing in its way.
    bool lights(const Vec3& at) const { return is_in_front(at) && foot(at); }

private:
    // Whether p is in front of the shape, and not so near that rounding decides: points of the shape itself are as far
    // from its plane as their errors and the plane's.
    bool is_in_front(const Vec3& p) const { return height(p) > 2.0 * error_; }
    double height(const Vec3& p) const { return glm::dot(p - corner_, normal_); }
    // The point of the shape's surface below p, if there is one.
    std::optional<SurfacePoint> foot(const Vec3& p) const;

    std::shared_ptr<const std::vector<Shape>> shapes_;
    std::uint32_t shape_;
    AreaLight light_;
    std::vector<Triangle> triangles_;  // if the shape is a mesh
    std::vector<double> cumulative_;   // of the triangles' areas
    Vec3 corner_, normal_;
    double error_, area_;
};

}  // namespace neumann
