#include "operators/fields/patches/shape_areas.h"

#include <oneapi/tbb/parallel_reduce.h>
#include <algorithm>
#include <cmath>
#include <map>

namespace neumann {

namespace {

// Maps that are written with six digits stretch one direction more than another by up to this.
constexpr double written_digits = 1e-5;

// Whether the map stretches all directions by the same factor, whose square is `scale`.
bool is_similarity(const glm::dmat3& map, double scale) {
    const glm::dmat3 squares = glm::transpose(map) * map;
    double most = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(squares[i][j] - (i == j ? scale : 0.0)));
    return most <= written_digits * scale;
}

// Adds up the faces; the sum is the same for any number of threads.
ShapeArea sum(std::uint32_t faces, const auto& area_of) {
    using Range = oneapi::tbb::blocked_range<std::uint32_t>;
    constexpr std::uint32_t at_once = 4096;
    return oneapi::tbb::parallel_deterministic_reduce(
        Range(0, faces, at_once), ShapeArea(),
        [&](const Range& range, ShapeArea result) {
            for (std::uint32_t face = range.begin(); face < range.end(); ++face) {
                const double area = area_of(face);
                result.area += area;
                result.largest_face = std::max(result.largest_face, area);
            }
            return result;
        },
        [](const ShapeArea& a, const ShapeArea& b) {
            return ShapeArea{a.area + b.area, std::max(a.largest_face, b.largest_face)};
        });
}

ShapeArea of_mesh(const TriangleMesh& mesh) {
    return sum(static_cast<std::uint32_t>(mesh.triangles.size()), [&](std::uint32_t face) {
        const auto corners = corners_of(mesh, face).at;
        return Triangle::area(corners[0], corners[1], corners[2]);
    });
}

}  // namespace

std::vector<ShapeArea> shape_areas(const Geometry& geometry) {
    std::map<const SharedMesh*, ShapeArea> of_shared;
    std::vector<ShapeArea> areas;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) {
        const auto of_face = [&](std::uint32_t face) { return geometry.area(shape, face); };
        const auto* instance = std::get_if<MeshInstance>(&geometry.shapes()[shape]);
        if (!instance) {
            areas.push_back(sum(geometry.primitive_count(shape), of_face));
            continue;
        }
        const auto [shared, is_new] = of_shared.try_emplace(instance->shared().get());
        if (is_new) shared->second = of_mesh(instance->mesh());
        const glm::dmat3 map(instance->to_world());
        const double stretch = std::cbrt(std::abs(glm::determinant(map))), scale = stretch * stretch;
        ShapeArea& own = areas.emplace_back();
        own.keeps_shares = is_similarity(map, scale);
        own.area = own.keeps_shares ? shared->second.area * scale : sum(geometry.primitive_count(shape), of_face).area;
        own.largest_face =
            shared->second.largest_face * scale * (own.keeps_shares ? 1.0 : instance->distortion() * instance->distortion());
    }
    return areas;
}

double sum_of_areas(const std::vector<ShapeArea>& shapes) {
    double sum = 0.0;
    for (const ShapeArea& shape : shapes) sum += shape.area;
    return sum;
}

}  // namespace neumann
