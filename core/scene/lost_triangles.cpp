#include "core/scene/lost_triangles.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>

namespace neumann {

namespace {

// Smallest value of twice the area, in Embree's coordinates; below it products of floats underflow.
constexpr double least_area = 1e-30;

bool is_lost(const RayCaster& caster, const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const auto rounded = [&](std::uint32_t vertex) { return Vec3(glm::vec3(caster.to_embree(mesh.vertices[vertex]))); };
    const Vec3 a = rounded(t[0]), b = rounded(t[1]), c = rounded(t[2]);
    return glm::length(glm::cross(b - a, c - a)) < least_area;
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
    std::vector<std::size_t> lost(shapes.size());
    oneapi::tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) {
        const auto* mesh = std::get_if<TriangleMesh>(&shapes[i]);
        if (!mesh) return;
        const auto& giants = geometry.giants();
        for (std::uint32_t k = 0; k < mesh->triangles.size(); ++k)
            lost[i] += is_lost(geometry.caster(), *mesh, mesh->triangles[k]) &&
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
