// What is closer together than Embree's floats can tell, asked in double: creases, thin gaps, surfaces that touch.
//
// Embree sees faces moved by up to their error (SurfacePoint::error), and a ray starts that far from its surface. A point is
// *close* where another face is nearer than both errors: there a ray could start behind that face, or end on the wrong one of the
// two. It is close, too, where a face that does not touch its own is nearer than 64 times that: below and beside it a ray sees what
// the point does not. Which parts of a face are close is found out when it is first hit, and kept; these parts are strips along
// edges, as a rule, a millionth of the scene wide. The rays of close points meet the faces around them in double, and Embree is
// asked for all others.
#pragma once

#include "core/geometry/double_faces.h"
#include "core/geometry/giants.h"
#include "core/geometry/ray_caster.h"
#include "core/geometry/surface_point.h"
#include "core/geometry/weight_cells.h"

#include <optional>
#include <utility>
#include <vector>

#include <oneapi/tbb/concurrent_map.h>
#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace neumann {

class Neighbours {
public:
    // The caster does not hold the giants.
    Neighbours(const DoubleFaces& faces, const Giants& giants, const RayCaster& caster);

    // Whether p, on its face, is close to another one.
    bool is_close(const SurfacePoint& p) const;
    // Whether Embree's ray, which begins up to the rounding of a place beside the real one, may have met p's face in place of
    // another one. `cosine`: of the ray with p's normal.
    bool may_hide(const SurfacePoint& p, double cosine) const;
    // The faces within rounding of p, with its own, in order.
    std::vector<Face> around(const SurfacePoint& p) const;

    struct Met {
        Face face;
        double distance;
    };
    // The first of the faces that a ray meets; none is behind the face that it starts on. `direction`: unit length.
    std::optional<Met> first(std::span<const Face> faces, const RayStart& start, const Vec3& direction) const;
    // Whether one of the faces lies strictly between x and y.
    bool any_between(std::span<const Face> faces, const SurfacePoint& x, const SurfacePoint& y) const;
    const DoubleFaces& faces() const { return faces_; }
    const Giants& giants() const { return giants_; }

private:
    using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Box = boost::geometry::model::box<Corner>;
    struct Other {
        Face face;
        double near;  // close where it is so near
    };
    using Boxes = boost::geometry::index::rtree<std::pair<Box, Other>, boost::geometry::index::linear<16>>;

    // What is close to the middle of a face is in the boxes and, of a triangle, for a first look, in the cells.
    struct Surroundings {
        Triangle::Cells cells;
        Boxes boxes;
    };
    void examine(const Face& f) const;
    // Whether the state of a round face is `clear`.
    bool is_clear_round(const Face& f) const;
    // Whether a face of the surroundings of p's own is so near, and `aside` more.
    bool has_near(const SurfacePoint& p, double aside) const;
    // Of triangles: whether nothing of f is on the side of own's plane that `direction` points to, where rays from own are.
    bool is_behind(const Face& f, const Face& own, const Vec3& direction) const;
    // How near to each other faces are that do not touch, and whose points are close.
    double reach(const Face& a, const Face& b) const;
    void append_near(const Vec3& p, double distance, std::vector<Face>& found) const;

    DoubleFaces faces_;
    Giants giants_;
    const RayCaster* caster_;
    std::vector<Face> large_;   // asked one by one, so that the others are found in small spheres
    double error_of_rest_ = 0;  // the largest of them
    double largest_error_ = 0;  // of all faces: how far beside the real one a ray may begin
    // Of round faces, by shape; of triangles, Triangle::is_clear() tells.
    enum class State : std::uint8_t { unknown, clear, not_clear };
    mutable std::vector<State> round_;
    mutable oneapi::tbb::concurrent_map<Face, Surroundings> surroundings_;
};

}  // namespace neumann
