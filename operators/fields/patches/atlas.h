// The charts of all surfaces, and the chart of a point. Two triangles that form a plane convex quadrilateral share a chart. Any
// other triangle has three charts, one at each corner, if it is larger than a patch, and otherwise one. The faces of a mesh that
// are smaller than half a patch share one chart of clusters, unless they are few. A sphere, a cylinder or a disc has one chart.
#pragma once

#include "operators/fields/patches/chart.h"
#include "operators/fields/patches/shape_areas.h"

#include <map>
#include <vector>

namespace neumann {

class Atlas {
public:
    // `patches` is the approximate number of patches.
    Atlas(const Geometry& geometry, const std::vector<ShapeArea>& areas, std::size_t patches);

    const std::vector<Chart>& charts() const { return charts_; }
    // Joins the small faces of a chart to this many clusters, or a few less.
    const FaceClusters& join(const Geometry& geometry, std::uint32_t chart, std::size_t clusters);
    std::uint32_t chart_of(const SurfacePoint& p) const {
        const OfShape& shape = shapes_[p.shape];
        if (shape.is_one_chart) return shape.chart;
        const Primitive& primitive = primitives_[shape.first + p.primitive];
        return primitive.cut ? primitive.chart + nearest_corner(primitive, p.position) : primitive.chart;
    }

private:
    struct OfShape {
        std::size_t first = 0;  // number of the shape's first primitive
        std::uint32_t chart = 0;
        bool is_one_chart = true;
    };
    struct Primitive {
        std::uint32_t chart = 0;
        std::uint32_t cut = 0;  // if the primitive is cut into three charts: 1 + index into cut_; otherwise 0
    };
    std::uint32_t nearest_corner(const Primitive& primitive, const Vec3& position) const;
    using Faces = std::vector<std::uint32_t>;
    // `small` are the faces that are joined.
    void add_mesh(const Geometry& geometry, std::uint32_t shape, Faces small, double patch_area);
    void add_faces(const Geometry& geometry, std::uint32_t shape, std::vector<bool> has_chart, double patch_area);
    void add_pairs(std::uint32_t shape, const Shape& mesh, std::vector<bool>& has_chart);

    std::vector<Chart> charts_;
    std::vector<OfShape> shapes_;
    std::vector<Primitive> primitives_;  // of all shapes that are not one chart, in order
    std::vector<Triangle> cut_;
    std::map<std::uint32_t, Faces> small_;  // faces of the charts that have not all faces of their shape
    // Clusters shared by instances that keep shares, by mesh and number of clusters.
    std::map<std::pair<const SharedMesh*, std::size_t>, std::shared_ptr<const FaceClusters>> shared_;
    std::vector<bool> keeps_shares_;  // by shape
};

}  // namespace neumann
