// A mesh that is in memory once and stands in the scene at several places. Each place is a shape of its own, whose triangles are
// placed, in double, when they are needed.
#pragma once

#include "core/geometry/triangle_mesh.h"

#include <memory>

namespace neumann {

// The mesh, in its own coordinates.
class SharedMesh {
public:
    // Throws InputError as expect_valid does. Degenerate triangles are left out.
    explicit SharedMesh(TriangleMesh mesh);

    const TriangleMesh& mesh() const { return mesh_; }
    std::size_t degenerate_count() const { return degenerate_count_; }
    const Bounds& bounds() const { return bounds_; }
    double longest_edge() const { return longest_edge_; }

private:
    TriangleMesh mesh_;
    std::size_t degenerate_count_;
    Bounds bounds_;
    double longest_edge_ = 0.0;
};

// The mesh under an invertible affine map. Front stays front, also if the map mirrors.
class MeshInstance {
public:
    MeshInstance(std::shared_ptr<const SharedMesh> shared, const Mat4& to_world);

    const std::shared_ptr<const SharedMesh>& shared() const { return shared_; }
    const TriangleMesh& mesh() const { return shared_->mesh(); }
    const Mat4& to_world() const { return to_world_; }
    // Whether the second and third corner of a triangle are exchanged.
    bool mirrors() const { return mirrors_; }
    // Maps a shading normal; the result is 0 if the normal is 0.
    Vec3 normal_to_world(const Vec3& n) const;
    // A box that contains the mesh, and may be larger.
    Bounds bounds() const;
    // A bound on the length of the longest edge.
    double longest_edge() const { return shared_->longest_edge() * stretch_; }
    // A bound on how many times more the map stretches one direction than another; 1 for a rotation about an axis.
    double distortion() const { return stretch_ * shrinking_; }

private:
    std::shared_ptr<const SharedMesh> shared_;
    Mat4 to_world_;
    glm::dmat3 of_normals_;  // up to a positive factor
    bool mirrors_;
    double stretch_, shrinking_;  // bounds on the norms of the map's linear part and of its inverse
};

TriangleCorners corners_of(const MeshInstance& instance, std::uint32_t triangle);

}  // namespace neumann
