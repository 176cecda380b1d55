#include "core/geometry/mesh_instance.h"

#include "core/geometry/affine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

// A bound on the spectral norm, by its column and row sums.
double norm_bound(const glm::dmat3& m) {
    const auto largest_column = [](const glm::dmat3& a) {
        double largest = 0.0;
        for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(a[i].x) + std::abs(a[i].y) + std::abs(a[i].z));
        return largest;
    };
    return std::sqrt(largest_column(m)) * std::sqrt(largest_column(glm::transpose(m)));
}

}  // namespace

SharedMesh::SharedMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {
    expect_valid(mesh_);
    degenerate_count_ = erase_degenerate_triangles(mesh_);
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        const TriangleCorners corners = corners_of(mesh_, i);
        bounds_.add(corners.bounds());
        longest_edge_ = std::max(longest_edge_, corners.longest_edge());
    }
}

MeshInstance::MeshInstance(std::shared_ptr<const SharedMesh> shared, const Mat4& to_world)
    : shared_(std::move(shared)),
      to_world_(to_world),
      of_normals_(map_of_normals(to_world)),
      mirrors_(is_mirroring(to_world)),
      stretch_(norm_bound(glm::dmat3(to_world))),
      shrinking_(norm_bound(glm::inverse(scaled_to_one(to_world))) / largest_entry(to_world)) {}

Vec3 MeshInstance::normal_to_world(const Vec3& n) const {
    if (n == Vec3(0.0)) return n;
    const Vec3 image = of_normals_ * n;
    return image / length_of(image);
}

Bounds MeshInstance::bounds() const {
    Bounds bounds;
    if (shared_->bounds().is_empty()) return bounds;
    const Vec3 ends[] = {shared_->bounds().low, shared_->bounds().high};
    for (unsigned i = 0; i < 8; ++i)
        bounds.add(transformed_point(to_world_, {ends[i & 1u].x, ends[i >> 1u & 1u].y, ends[i >> 2u].z}));
    return bounds;
}

TriangleCorners corners_of(const MeshInstance& instance, std::uint32_t triangle) {
    TriangleCorners corners = corners_of(instance.mesh(), triangle);
    for (Vec3& corner : corners.at) corner = transformed_point(instance.to_world(), corner);
    if (instance.mirrors()) {
        std::swap(corners.at[1], corners.at[2]);
        std::swap(corners.vertices[1], corners.vertices[2]);
    }
    return corners;
}

}  // namespace neumann
