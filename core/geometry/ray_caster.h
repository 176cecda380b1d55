// The one place that knows Embree (3.13 or 4): closest hits and occlusion among triangles, spheres and discs, in floats and in
// coordinates of about unit size. Spheres and discs are intersected in double, so they are as exact as the ray.
#pragma once

#include "core/geometry/ray.h"
#include "core/geometry/shape.h"

#include <memory>
#include <span>

struct RTCSceneTy;

namespace neumann {

class RayCaster {
public:
    // Coordinates are moved by −center and multiplied by scale before Embree sees them. Triangles, spheres and discs that have no
    // extent must have been taken out.
    RayCaster(const std::vector<Shape>& shapes, const Vec3& center, double scale);
    ~RayCaster();

    struct Hit {
        std::uint32_t shape, primitive;
        float u, v;       // barycentric weights of the second and third vertex (triangles)
        double distance;  // in units of |direction|, scene units
    };
    // The first thing hit by origin + t·direction, 0 < t < distance, if any. Scene units.
    bool intersect(const Vec3& origin, const Vec3& direction, double distance, Hit& hit) const;
    // Whether anything lies strictly between two points.
    bool occluded(const Vec3& from, const Vec3& to) const;

    // The same for up to 8 rays at once, which is faster where they are alike; bit i of the answer belongs to ray i.
    static constexpr std::size_t packet = 8;
    std::uint32_t intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
    std::uint32_t occluded(std::span<const Vec3> from, std::span<const Vec3> to) const;

    // For benchmarks that cast the same rays without anything around them.
    RTCSceneTy* embree_scene() const;
    Vec3 to_embree(const Vec3& p) const { return (p - center_) * scale_; }
    double scale() const { return scale_; }

private:
    struct Impl;
    Vec3 center_;
    double scale_;
    std::unique_ptr<Impl> impl_;
};

// Which Embree is linked, such as "Embree 3.13.5".
const char* embree_version();

}  // namespace neumann
