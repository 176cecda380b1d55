// The charts of all surfaces, and which of them a point is on. Two triangles that make up a plane convex quadrilateral share a
// chart; any other triangle has three of them, one at each corner, where it is larger than a patch is to be, and one where it is
// not. A sphere, a cylinder or a disc has one.
#pragma once

#include "operators/patches/chart.h"

#include <vector>

namespace neumann {

class Atlas {
public:
    // `patch_area`: about what a patch will have.
    Atlas(const Geometry& geometry, double patch_area);

    const std::vector<Chart>& charts() const { return charts_; }
    std::uint32_t chart_of(const SurfacePoint& p) const {
        const Primitive& primitive = primitives_[first_of_shape_[p.shape] + p.primitive];
        return primitive.cut ? primitive.chart + nearest_corner(primitive, p.position) : primitive.chart;
    }

private:
    struct Primitive {
        std::uint32_t chart = 0;
        std::uint32_t cut = 0;  // into three charts, one at each corner: 1 + index into cut_
    };
    std::uint32_t nearest_corner(const Primitive& primitive, const Vec3& position) const;
    void add_mesh(std::uint32_t shape, const TriangleMesh& mesh, double patch_area);
    void add_pairs(std::uint32_t shape, const TriangleMesh& mesh, std::vector<bool>& has_chart);

    std::vector<Chart> charts_;
    std::vector<Primitive> primitives_;  // of all shapes one after another
    std::vector<std::size_t> first_of_shape_;
    std::vector<Triangle> cut_;
};

}  // namespace neumann
