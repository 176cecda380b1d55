// The charts of all surfaces, and the chart of a point. Two triangles that form a plane convex quadrilateral share a chart. Any
// other triangle has three charts, one at each corner, if it is larger than a patch, and otherwise one. A sphere, a cylinder or a
// disc has one.
#pragma once

#include "operators/patches/chart.h"

#include <vector>

namespace neumann {

class Atlas {
public:
    // `patch_area`: the approximate area of a patch.
    Atlas(const Geometry& geometry, double patch_area);

    const std::vector<Chart>& charts() const { return charts_; }
    std::uint32_t chart_of(const SurfacePoint& p) const {
        const Primitive& primitive = primitives_[first_of_shape_[p.shape] + p.primitive];
        return primitive.cut ? primitive.chart + nearest_corner(primitive, p.position) : primitive.chart;
    }

private:
    struct Primitive {
        std::uint32_t chart = 0;
        std::uint32_t cut = 0;  // if cut into three charts: 1 + index into cut_; otherwise 0
    };
    std::uint32_t nearest_corner(const Primitive& primitive, const Vec3& position) const;
    void add_mesh(std::uint32_t shape, const TriangleMesh& mesh, double patch_area);
    void add_pairs(std::uint32_t shape, const TriangleMesh& mesh, std::vector<bool>& has_chart);

    std::vector<Chart> charts_;
    std::vector<Primitive> primitives_;  // of all shapes, in order
    std::vector<std::size_t> first_of_shape_;
    std::vector<Triangle> cut_;
};

}  // namespace neumann
