#include "core/scene/lost_triangles.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <map>

namespace neumann {

namespace {

// Smallest value of twice the area, in Embree's coordinates; below it products of floats underflow.
constexpr double least_area = 1e-30;

template <class ToEmbree>
bool is_lost(const TriangleMesh& mesh, std::uint32_t triangle, const ToEmbree& to_embree) {
    TriangleCorners corners = corners_of(mesh, triangle);
    for (Vec3& corner : corners.at) corner = Vec3(glm::vec3(to_embree(corner)));
    const auto& [a, b, c] = corners.at;
    return glm::length(glm::cross(b - a, c - a)) < least_area;
}

// Embree scales a mesh that has instances to unit size, so it is the same for all of them.
std::size_t count_lost(const SharedMesh& shared) {
    const double scale = scale_to_one(shared.bounds());
    std::size_t lost = 0;
    for (std::uint32_t k = 0; k < shared.mesh().triangles.size(); ++k)
        lost += is_lost(shared.mesh(), k, [&](const Vec3& p) { return (p - shared.bounds().center()) * scale; });
    return lost;
}

bool is_too_small(const MeshInstance& instance, const Geometry& geometry) {
    constexpr double least_part = 1e-7;
    return instance.bounds().radius() < least_part * geometry.radius();
}

// The median of the triangles' vertices, coordinate by coordinate.
Vec3 median_vertex(const TriangleMesh& mesh) {
    Vec3 median;
    std::vector<double> values;
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (const auto& t : mesh.triangles)
            for (const std::uint32_t vertex : t) values.push_back(mesh.vertices[vertex][axis]);
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        median[axis] = *middle;
    }
    return median;
}

}  // namespace

LostTriangles lost_triangles(const Geometry& geometry) {
    const auto& shapes = geometry.shapes();
    std::map<const SharedMesh*, std::size_t> of_shared;
    for (const Shape& shape : shapes)
        if (const auto* instance = std::get_if<MeshInstance>(&shape); instance && !of_shared.contains(instance->shared().get()))
            of_shared[instance->shared().get()] = count_lost(*instance->shared());
    std::vector<std::size_t> lost(shapes.size());
    oneapi::tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) {
        if (const auto* instance = std::get_if<MeshInstance>(&shapes[i])) {
            lost[i] =
                is_too_small(*instance, geometry) ? instance->mesh().triangles.size() : of_shared.at(instance->shared().get());
            return;
        }
        const auto* mesh = std::get_if<TriangleMesh>(&shapes[i]);
        if (!mesh) return;
        const auto& giants = geometry.giants();
        for (std::uint32_t k = 0; k < mesh->triangles.size(); ++k)
            lost[i] += is_lost(*mesh, k, [&](const Vec3& p) { return geometry.caster().to_embree(p); }) &&
                       !std::binary_search(giants.begin(), giants.end(), Face{static_cast<std::uint32_t>(i), k});
    });
    LostTriangles found;
    for (std::uint32_t shape = 0; shape < shapes.size(); ++shape) {
        if (lost[shape] == 0) continue;
        if (found.count == 0) found.first = shape;
        found.count += lost[shape];
        if (!found.whole && lost[shape] == geometry.primitive_count(shape)) found.whole = shape;
    }
    return found;
}

std::optional<FarVertex> farthest_vertex(const Geometry& geometry, std::uint32_t from) {
    const auto& shapes = geometry.shapes();
    const auto* seen_from = std::get_if<TriangleMesh>(&shapes[from]);
    if (!seen_from || seen_from->triangles.empty()) return std::nullopt;
    const Vec3 origin = median_vertex(*seen_from);
    std::optional<FarVertex> found;
    double largest = 0.0;
    for (std::uint32_t shape = 0; shape < shapes.size(); ++shape) {
        const auto* mesh = std::get_if<TriangleMesh>(&shapes[shape]);
        if (!mesh) continue;
        for (const auto& t : mesh->triangles)
            for (const std::uint32_t vertex : t) {
                const double distance = max_component(glm::abs(mesh->vertices[vertex] - origin));
                if (distance <= largest) continue;
                largest = distance;
                found = FarVertex{shape, mesh->vertices[vertex]};
            }
    }
    // From a point in a box of half diagonal r the farthest corner is at least r/√3 away in one coordinate.
    return largest >= 0.99 * geometry.radius() / std::sqrt(3.0) ? found : std::nullopt;
}

}  // namespace neumann
