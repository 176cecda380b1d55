// The only user of Embree (3.13 or 4): closest hits and occlusion, in floats and in coordinates of about unit size. Spheres, discs
// and cylinders are intersected in double, so they are as exact as the ray. Instances are Embree's; their mesh, too, is moved and
// scaled to unit size.
#pragma once

#include "core/geometry/face.h"
#include "core/geometry/ray.h"
#include "core/geometry/shape.h"

#include <memory>
#include <span>
#include <vector>

struct RTCSceneTy;
struct RTCRay8;

namespace neumann {

class RayCaster {
public:
    // Coordinates are moved by −center and multiplied by `scale` for Embree. Triangles without extent must have been removed; other
    // shapes without extent, and the sorted faces `without`, are left out. The shapes must outlive the caster.
    RayCaster(const std::vector<Shape>& shapes, std::span<const Face> without, const Vec3& center, double scale);
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

    // The same for up to 8 rays at once, which is faster; bit i of the result is for ray i. Rays::alike is for coherent rays, such
    // as those of one pixel.
    static constexpr std::size_t packet_size = 8;
    enum class Rays { alike, any };
    class Packet;
    std::uint32_t intersect(const Packet& rays, std::span<Hit> hits, Rays kind) const;
    std::uint32_t occluded(const Packet& rays, Rays kind) const;

    // The same without some faces, which are sorted.
    bool intersect(const Vec3& origin, const Vec3& direction, double distance, std::span<const Face> without, Hit& hit) const;
    bool occluded(const Vec3& from, const Vec3& to, std::span<const Face> without) const;

    // Appends the faces between two points, except some, up to `most` faces in all.
    void append_between(const Vec3& from, const Vec3& to, std::span<const Face> without, std::size_t most,
                        std::vector<Face>& found) const;
    // Whether is_wanted(face) is true of one of the faces closer to p than `distance`, and possibly of others. The search ends with
    // the first.
    template <class IsWanted>
    bool any_near(const Vec3& p, double distance, const IsWanted& is_wanted) const {
        const auto test = [](const void* wanted, const Face& face) { return (*static_cast<const IsWanted*>(wanted))(face); };
        return any_near(p, distance, test, &is_wanted);
    }

    // For benchmarks that call Embree directly.
    RTCSceneTy* embree_scene() const;
    Vec3 to_embree(const Vec3& p) const { return (p - center_) * scale_; }
    double scale() const { return scale_; }

private:
    struct Impl;
    static void set_rays(const Packet& packet, RTCRay8& rays);
    bool any_near(const Vec3& p, double distance, bool (*test)(const void*, const Face&), const void* wanted) const;
    Vec3 center_;
    double scale_;
    std::unique_ptr<Impl> impl_;
};

// A packet of rays in Embree's layout.
class RayCaster::Packet {
public:
    explicit Packet(const RayCaster& caster) : center_(caster.center_), scale_(caster.scale_) {}

    void add(const Vec3& origin, const Vec3& direction, double length = std::numeric_limits<double>::infinity()) {
        set((origin - center_) * scale_, direction, static_cast<float>(length * scale_));
    }
    void add_segment(const Vec3& from, const Vec3& to) { set((from - center_) * scale_, (to - from) * scale_, 1.0f); }

private:
    friend class RayCaster;
    void set(const Vec3& o, const Vec3& d, float length) {
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis][size_] = static_cast<float>(o[axis]);
            direction_[axis][size_] = static_cast<float>(d[axis]);
        }
        length_[size_++] = length;
    }

    Vec3 center_;
    double scale_;
    std::size_t size_ = 0;
    float origin_[3][packet_size]{}, direction_[3][packet_size]{}, length_[packet_size]{};
};

// The version of Embree, such as "Embree 3.13.5".
const char* embree_version();
// Number of acceleration structures that this program has built so far.
std::uint64_t trees_built();

}  // namespace neumann
