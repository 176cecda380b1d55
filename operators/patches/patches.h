// Surfaces cut into patches: a grid on each chart, finer towards its edges. Geometry only.
#pragma once

#include "operators/patches/atlas.h"

#include <array>
#include <cstdint>
#include <vector>

namespace neumann {

struct Patching {
    std::size_t patches = 4000;  // about as many; at least one a chart
    double grading = 0.7;        // in [0, 1): the cells at an edge are 1 − grading times as wide as they would be without
};

class Patches {
public:
    // Throws InputError where there are no surfaces or no patches are asked for.
    Patches(const Geometry& geometry, const Patching& patching);

    // Patches twice as wide in both directions, where a chart has so many.
    Patches coarser() const;
    // The coarser patch around each patch.
    std::vector<std::uint32_t> coarser_of_each() const;

    std::size_t size() const { return cells_.size(); }
    double area(std::uint32_t patch) const { return areas_[patch]; }
    const Chart& chart(std::uint32_t patch) const { return charts()[chart_of_[patch]]; }

    std::uint32_t locate(const SurfacePoint& p) const {
        const std::uint32_t chart = atlas_.chart_of(p);
        const Vec2 st = charts()[chart].coordinates(*geometry_, p.position);
        const Grid& grid = grids_[chart];
        return grid.first + cell(grid.t, st.y) * size_of(grid.s) + cell(grid.s, st.x);
    }
    // Uniform by area for uniform u in [0, 1)².
    SurfacePoint point(std::uint32_t patch, const Vec2& u) const {
        const Chart& chart = charts()[chart_of_[patch]];
        return chart.point(*geometry_, chart.uniform(cells_[patch], u));
    }

    // A function that has its values at the middles of the patches, linear between them and on to the edge, is at a point the sum
    // of these values times these weights. Within a chart only: an edge separates.
    struct Reading {
        std::array<std::uint32_t, 4> patch;
        std::array<double, 4> weight;
    };
    Reading interpolate(const SurfacePoint& p) const;

    const Geometry& geometry() const { return *geometry_; }

private:
    struct Axis {
        std::vector<double> ends, middles;  // of the cells
        bool closed = false;                // the last cell is beside the first
    };
    struct Grid {
        Axis s, t;
        std::uint32_t first;
    };
    struct Neighbours {
        std::uint32_t low, high;
        double weight;  // of `high`
    };
    static Axis axis(std::size_t cells, double grading, bool closed);
    static Axis axis(std::vector<double> ends, bool closed);
    static Axis coarser(const Axis& axis);
    static std::uint32_t coarser_cell(const Axis& axis, std::uint32_t cell);
    void add_grid(Axis s, Axis t);
    static std::uint32_t size_of(const Axis& axis) { return static_cast<std::uint32_t>(axis.middles.size()); }
    static std::uint32_t cell(const Axis& axis, double x);
    static Neighbours neighbours(const Axis& axis, double x);
    const std::vector<Chart>& charts() const { return atlas_.charts(); }
    Patches(const Geometry& geometry, Atlas atlas) : geometry_(&geometry), atlas_(std::move(atlas)) {}

    const Geometry* geometry_;
    Atlas atlas_;
    std::vector<Grid> grids_;  // of each chart
    std::vector<Cell> cells_;
    std::vector<double> areas_;
    std::vector<std::uint32_t> chart_of_;
};

}  // namespace neumann
