// Fields f_k ≈ K^k Le, k ≥ 1, on diffuse sides, interpolated bilinearly on a raster over each chart, so that a hit
// reads all bounces from four neighbouring places. K Le has a finer raster of its own, as its shadows have edges. On
// clusters of faces the fields are constant, and K Le is constant on parts of clusters.
#pragma once

#include "operators/fields/matrix/field_stack.h"
#include "operators/paths/corrected/diffuse_sides.h"
#include "operators/watch.h"

#include <array>
#include <cstdint>
#include <vector>

namespace neumann {

class FieldRaster {
public:
    // About the number of rays for K Le for each side of a patch: light_samples for each node of the finer raster.
    static constexpr std::uint32_t light_samples = 16, fine_nodes_of_patch = 24,
                                   rays_of_facet = light_samples * fine_nodes_of_patch;

    // `fields` has the bounces 0 … N and the rest. Keeps references to the scene and to the space of `fields`.
    // Throws Stopped if `watch` stops it.
    FieldRaster(const Scene& scene, const DiffuseSides& sides, const FieldStack& fields, std::uint64_t seed,
                const Watch& watch = {});

    // The number of fields, f_1 … f_N and Σ_{k>N} f_k.
    std::size_t size() const { return stride_ / 3; }
    std::uint64_t rays() const { return rays_; }  // cast for K Le

    // Whether there are fields, and patches on which points may be drawn, on this side.
    bool covers(const SurfacePoint& p, bool front) const { return has_side_[space_->patches().chart_of(p)][front ? 0 : 1]; }
    // Whether the normals on the shape of p may be interpolated.
    bool is_smooth(const SurfacePoint& p) const { return is_smooth_[p.shape]; }
    // f_1(p), f_2(p), … on a side that has fields: three floats each, 3 size() in all.
    void read(const SurfacePoint& p, bool front, float* fields) const {
        const std::uint32_t number = space_->patches().chart_of(p);
        if (const FaceClusters* clusters = space_->patches().charts()[number].clusters()) {
            const std::size_t side = front ? 0 : 1;
            const Grid &grid = grids_[number], &fine = fine_grids_[number];
            const float* const later =
                values_.data() + (grid.first[side] + space_->patches().locate(p) - grid.first_patch) * stride_;
            const float* const direct = fine_.data() + 3 * (fine.first[side] + column(fine, clusters->place(p.primitive)));
            std::copy_n(later, stride_, fields);
            std::copy_n(direct, 3, fields);
            return;
        }
        const ChartCoordinates place = coordinates_on(number, p.position);
        blend(values_.data(), stride_, stride_, corners(grids_[number], place, front), fields);
        blend(fine_.data(), 3, 3, corners(fine_grids_[number], place, front), fields);
    }

private:
    // Nodes at the chart's coordinates (i/(columns−1), j/(rows−1)); for clusters, one for each cluster, or for each of
    // equal parts of s.
    struct Grid {
        std::uint32_t columns = 0, rows = 0;
        std::uint32_t first_patch = 0;
        std::array<std::size_t, 2> first{};  // first node of the front and of the back
    };
    struct ChartCoordinates {
        float s, t;  // in [0, 1]
    };
    struct Corners {
        std::array<std::size_t, 4> node;
        std::array<float, 4> weight;
    };
    ChartCoordinates coordinates_on(std::uint32_t chart, const Vec3& position) const {
        const Vec2 st = space_->patches().charts()[chart].coordinates(space_->geometry(), position);
        return {std::clamp(static_cast<float>(st.x), 0.0f, 1.0f), std::clamp(static_cast<float>(st.y), 0.0f, 1.0f)};
    }
    static Corners corners(const Grid& grid, const ChartCoordinates& place, bool front) {
        const float x = place.s * static_cast<float>(grid.columns - 1), y = place.t * static_cast<float>(grid.rows - 1);
        const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
        const std::uint32_t right = i + 1 < grid.columns ? 1 : 0, below = j + 1 < grid.rows ? grid.columns : 0;
        const float a = x - static_cast<float>(i), b = y - static_cast<float>(j);
        const std::size_t node = grid.first[front ? 0 : 1] + std::size_t{j} * grid.columns + i;
        return {{node, node + right, node + below, node + below + right}, {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b}};
    }
    static void blend(const float* values, std::size_t stride, std::size_t count, const Corners& c, float* __restrict to) {
        const float *const v0 = values + c.node[0] * stride, *const v1 = values + c.node[1] * stride,
                           *const v2 = values + c.node[2] * stride, *const v3 = values + c.node[3] * stride;
        for (std::size_t k = 0; k < count; ++k)
            to[k] = (c.weight[0] * v0[k] + c.weight[1] * v1[k]) + (c.weight[2] * v2[k] + c.weight[3] * v3[k]);
    }
    static std::uint32_t column(const Grid& grid, double s) {
        return std::min(static_cast<std::uint32_t>(s * grid.columns), grid.columns - 1);
    }
    Grid make_grid(std::uint32_t chart, double cells, std::size_t& nodes) const;
    // A point of the raster, a little inside of the chart.
    SurfacePoint node(std::uint32_t chart, const Grid& grid, std::uint32_t column, std::uint32_t row) const;
    SurfacePoint place_in_part(std::uint32_t chart, const Grid& grid, std::uint32_t column, std::uint32_t i) const;
    void fill(const FieldStack& fields);
    void fill_direct(const Scene& scene, std::uint64_t seed, const Watch& watch);

    const PatchSpace* space_;
    std::size_t stride_;
    std::vector<std::array<bool, 2>> has_side_;  // one per chart
    std::vector<bool> is_smooth_;                // by shape
    std::vector<Grid> grids_, fine_grids_;
    std::vector<float> values_, fine_;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
