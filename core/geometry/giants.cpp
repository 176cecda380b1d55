#include "core/geometry/giants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

constexpr std::size_t most_giants = 16;
// A giant is at least this many times as large as all other faces together,
constexpr double larger = 16.0;
// and at most this many times: beyond that, doubles cannot resolve what lies on it.
constexpr double largest_ratio = 0x1p27;
// In a scene of few faces, all of them are giants if the longest length is more than this many times the thinnest width.
constexpr double longer = 256.0;

struct Sized {
    Face face;
    double size;  // length of the longest edge, or size of the box around a round face
    Bounds bounds;
};

}  // namespace

std::optional<Giants::Part> Giants::near_rest(const Vec3& origin, const Vec3& direction, double distance) const {
    if (faces.empty()) return Part{0.0, distance};
    if (rest.is_empty()) return std::nullopt;
    const double radius = 2.0 * rest.radius();
    const Vec3 f = origin - rest.center();
    const double middle = -glm::dot(f, direction);
    const Vec3 nearest = f + direction * middle;
    const double square = radius * radius - glm::dot(nearest, nearest);
    if (!(square > 0.0)) return std::nullopt;
    const double half = std::sqrt(square);
    const Part part{std::max(middle - half, 0.0), std::min(middle + half, distance)};
    return part.begin < part.end ? std::optional(part) : std::nullopt;
}

Giants find_giants(const std::vector<Shape>& shapes) {
    std::vector<Sized> largest;  // a heap with the smallest on top
    const auto is_larger = [](const Sized& a, const Sized& b) { return a.size > b.size; };
    std::size_t count = 0;
    double thinnest = std::numeric_limits<double>::infinity();
    Giants result;
    const auto add = [&](const Sized& face) {
        ++count;
        largest.push_back(face);
        std::push_heap(largest.begin(), largest.end(), is_larger);
        if (largest.size() <= most_giants) return;
        std::pop_heap(largest.begin(), largest.end(), is_larger);
        result.rest.add(largest.back().bounds);
        largest.pop_back();
    };
    for (std::uint32_t shape = 0; shape < shapes.size(); ++shape) {
        if (!has_extent(shapes[shape])) continue;
        if (const auto* instance = std::get_if<MeshInstance>(&shapes[shape])) {
            result.rest.add(instance->bounds());
            count += instance->mesh().triangles.size();
        } else if (const auto* mesh = std::get_if<TriangleMesh>(&shapes[shape])) {
            for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
                const TriangleCorners corners = corners_of(*mesh, i);
                const auto& [a, b, c] = corners.at;
                const double longest = corners.longest_edge();
                add({{shape, i}, longest, corners.bounds()});
                thinnest = std::min(thinnest, glm::length(glm::cross(b - a, c - a)) / longest);
            }
        } else {
            const Bounds bounds = bounds_of(shapes[shape]);
            add({{shape, 0}, 2.0 * bounds.radius(), bounds});
            const Vec3 extent = bounds.high - bounds.low;
            thinnest = std::min(thinnest, std::max({extent.x, extent.y, extent.z}));
        }
    }
    if (largest.empty()) return result;

    std::sort(largest.begin(), largest.end(), is_larger);
    // The largest number of giants that dwarf the rest.
    std::size_t giants = largest.size();
    const auto dwarf = [&] {
        const double rest = 2.0 * result.rest.radius();
        return !result.rest.is_empty() && largest[giants - 1].size > larger * rest && largest.front().size < largest_ratio * rest;
    };
    while (giants > 0 && !dwarf()) result.rest.add(largest[--giants].bounds);
    const double longest = largest.front().size;
    if (giants == 0 && count == largest.size() && longest > longer * thinnest && longest < largest_ratio * thinnest) {
        giants = count;
        result.rest = {};
    }
    for (std::size_t k = 0; k < giants; ++k) result.faces.push_back(largest[k].face);
    std::sort(result.faces.begin(), result.faces.end());
    return result;
}

}  // namespace neumann
