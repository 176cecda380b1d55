// Faces that are closer together than Embree's floats can resolve (creases, thin gaps, surfaces that touch) are
// intersected in double.
//
// Embree holds faces that are displaced by up to their error (SurfacePoint::error), and a ray starts that far from its
// surface. A point is *close* if another face is nearer than the sum of both errors: a ray could start behind that
// face, or end on the wrong one of the two. It is also close if a face that does not touch its own is nearer than 64
// times that, because a ray with an offset origin sees past it what the point does not see. Rays of close points are
// intersected with the faces around them in double, and with all others by Embree.
//
// Faces near a point are searched in Embree's tree. For a face that is searched more than a few times, the parts that
// can have close points at all are determined once, usually strips along edges, a millionth of the scene wide; points
// elsewhere are clear without a search, with the same result. Nothing is kept for a face with a crowd around it:
// otherwise a scene whose faces are long and thin, or share a corner, would take time with the square of their number.
// Nothing is kept either for the faces of instances, of which there may be a thousand times more than fit in memory.
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
    // `caster` must not contain the giants.
    Neighbours(const DoubleFaces& faces, const Giants& giants, const RayCaster& caster);

    // Whether p, on its face, is close to another one.
    bool is_close(const SurfacePoint& p) const;
    // Whether Embree's ray, whose origin is displaced by rounding, may have hit p's face in place of another one; if
    // not, p is not close. `cosine` is between the ray and p's normal.
    bool may_hide(const SurfacePoint& p, double cosine) const;
    // If p, hit by this ray, lies on faces that cross its own, within rounding, moves it along its own face to the side of them
    // from which the ray came, so that rays know on which side of them they start. Without a ray, p stays on the side where it is.
    void part(SurfacePoint& p, const StartedRay* ray) const;
    // The faces within rounding of p, including its own, in order.
    std::vector<Face> around(const SurfacePoint& p) const;

    struct Met {
        Face face;
        double distance;
    };
    // The first of the faces that a ray hits, without those behind the face on which it starts. `direction` has unit length.
    std::optional<Met> first(std::span<const Face> faces, const RayStart& start, const Vec3& direction) const;
    // Whether one of the faces lies strictly between x and y.
    bool any_between(std::span<const Face> faces, const SurfacePoint& x, const SurfacePoint& y) const;
    const DoubleFaces& faces() const { return faces_; }
    const Giants& giants() const { return giants_; }

private:
    using BoxPoint = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Box = boost::geometry::model::box<BoxPoint>;
    struct Other {
        Face face;
        double near;  // points closer to the face than this are close
    };
    using Boxes = boost::geometry::index::rtree<std::pair<Box, Other>, boost::geometry::index::linear<16>>;

    // The faces close to the interior of a face, in boxes; for a triangle, the cells allow a quick first test. For a
    // triangle that is large among a crowd only the cells are kept.
    struct Surroundings {
        WeightCells cells;
        Boxes boxes;
        bool crowded = false;
    };
    struct Reach {
        double distance;  // points of the face that are nearer than this to the other one are close; 0 if the other continues it
        bool touches;
    };
    Reach reach_of_close_points(const Face& f, const Face& other) const;
    // Searches for another face that is as near to p as that, plus `aside`.
    bool is_near_other(const SurfacePoint& p, double aside) const;
    void examine(const Face& f) const;
    // The faces that may have close points on f, or as many of them as are a crowd.
    struct Others {
        std::vector<Face> faces;
        bool crowd = false;
    };
    Others others_around(const Face& f) const;
    void examine_among_crowd(const Face& f, const std::vector<Face>& some) const;
    // Marks the cells of the triangle f that may be close to others, within one square of weights; row and column are
    // those of the square.
    void mark_near_others(const Face& f, int column, int row, int squares, WeightCells& cells) const;
    enum class State : std::uint8_t { unknown, clear, not_clear, crowded };
    State state_of_round(const Face& f) const;
    // Whether is_near_other() may hold for p: whether a face in the boxes of p's face is within its `near` distance plus `aside`.
    bool is_in_boxes(const SurfacePoint& p, double aside) const;
    // Does what first() does, except for rays that pass an edge within rounding.
    std::optional<Met> nearest(std::span<const Face> faces, const RayStart& start, const Vec3& direction) const;
    // For triangles: whether f lies entirely on the other side of the plane of `own` than `direction`.
    bool is_behind(const Face& f, const Face& own, const Vec3& direction) const;
    // The distance below which two faces that do not touch have close points.
    double reach(const Face& a, const Face& b) const;
    // `errors` is the sum of both faces' errors, and `smaller` the size of the smaller face.
    static double reach(double errors, double smaller);
    void append_near(const Vec3& p, double distance, std::vector<Face>& found) const;

    DoubleFaces faces_;
    Giants giants_;
    const RayCaster* caster_;
    // Faces tested one by one, so that small search spheres suffice for the others.
    struct Large {
        Face face;
        Bounds bounds;
        double error;
    };
    std::vector<Large> large_;
    double error_of_rest_ = 0;          // the largest error of the others
    double largest_error_ = 0;          // the largest error of all faces: how far an origin of a ray may be displaced
    mutable std::vector<State> round_;  // for round faces, by shape; triangles have Triangle::is_clear()
    mutable oneapi::tbb::concurrent_map<Face, Surroundings> surroundings_;
};

}  // namespace neumann
