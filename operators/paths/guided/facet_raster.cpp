#include "operators/paths/guided/facet_raster.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Raster cells per patch, on average over a chart: patches at edges are smaller.
constexpr double cells_per_patch = 16.0;

}  // namespace

FacetRaster::FacetRaster(const PatchSpace& space) : space_(&space) {
    const Patches& patches = space.patches();
    std::vector<double> patches_of(patches.charts().size());
    for (std::uint32_t patch = 0; patch < patches.size(); ++patch) patches_of[patches.chart_number(patch)] += 1.0;

    for (std::uint32_t number = 0; number < patches.charts().size(); ++number) {
        const Chart& chart = patches.charts()[number];
        Grid& grid = grids_.emplace_back();
        if (!chart.is_plane()) continue;
        const auto& corners = chart.corners();
        const Vec3 x = glm::normalize(corners[1] - corners[0]), y = glm::cross(chart.normal(), x);
        Vec2 low(0.0), high(0.0);
        for (const Vec3& corner : corners) {
            const Vec2 p(glm::dot(corner - corners[0], x), glm::dot(corner - corners[0], y));
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const Vec2 size = high - low;
        const double cell = std::sqrt(size.x * size.y / (cells_per_patch * patches_of[number]));
        const auto count = [&](double length) {
            return patches_of[number] == 1.0 ? 1u : static_cast<std::uint32_t>(std::clamp(length / cell, 1.0, 4096.0));
        };
        grid.corner = corners[0] + x * low.x + y * low.y;
        grid.columns = count(size.x);
        grid.rows = count(size.y);
        grid.across = x * (grid.columns / size.x);
        grid.down = y * (grid.rows / size.y);
        grid.first = sides_.size();
        for (std::uint32_t row = 0; row < grid.rows; ++row)
            for (std::uint32_t column = 0; column < grid.columns; ++column) {
                const Vec3 middle =
                    grid.corner + x * ((column + 0.5) / grid.columns * size.x) + y * ((row + 0.5) / grid.rows * size.y);
                const std::uint32_t patch = patches.locate(patches.place(number, middle));
                sides_.push_back({space.facet(patch, true), space.facet(patch, false)});
            }
    }
}

}  // namespace neumann
