// Faces of a mesh that are smaller than patches, joined into clusters: near each other, with similar normals, and of about equal
// area. All faces stand in one order, in which each cluster is a range whose neighbours are close, too: a range is halved at the
// mean of whatever varies most, of positions and of normals (top-down as in Wald, On fast construction of SAH-based bounding volume
// hierarchies, 2007; clusters of faces for radiosity: Willmott, Heckbert and Garland, Face cluster radiosity, 1999). The place of a
// face is the share of area before it in this order, so every range of places is sampled uniformly by area.
#pragma once

#include "core/geometry/geometry.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

class FaceClusters {
public:
    // Joins the `faces` of a mesh or of an instance, each with an area, to at most `clusters` clusters, and no more than there are
    // faces. O(n log n). Other instances of the mesh have the same clusters if the maps stretch all directions alike.
    FaceClusters(const Geometry& geometry, std::uint32_t shape, std::vector<std::uint32_t> faces, std::size_t clusters);

    // The ends of the clusters: 0, …, 1, shares of the area.
    const std::vector<double>& ends() const { return ends_; }
    // The number of successive clusters that are joined in a coarser patch.
    static constexpr std::uint32_t joined = 4;

    // The share of area before a face.
    double place(std::uint32_t face) const { return place_[rank_[face]]; }
    // Area-preserving coordinates of points in [0, 1)²: s is the share of area before the point, t runs across its face.
    Vec2 coordinates(const Geometry& geometry, const SurfacePoint& p) const;
    SurfacePoint bare_point(const Geometry& geometry, std::uint32_t shape, const Vec2& st) const;
    // The faces that begin in a range of places.
    std::span<const std::uint32_t> faces(double from, double to) const;

private:
    std::vector<std::uint32_t> faces_;  // in order
    std::vector<std::uint32_t> rank_;   // for each face of the mesh, its position in the order
    std::vector<double> place_;         // for each position in the order, the share of area before it; and 1
    std::vector<double> ends_;
};

}  // namespace neumann
