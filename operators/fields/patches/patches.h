// Surfaces cut into patches: the cells of a grid on each chart, finer towards its edges, and cut again along the
// outlines of surfaces that touch the chart. Faces that are smaller than patches are joined into clusters, each of
// which is a patch. Geometry only.
#pragma once

#include "operators/fields/patches/atlas.h"
#include "operators/fields/patches/parts.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

struct Patching {
    std::size_t patches = 4000;  // approximate number; at least four per chart, if `compared`
    double grading = 0.7;        // in [0, 1): cells at an edge are narrower by the factor 1 − grading
    // The patches are compared with coarser(), so these two have to differ on every chart. Otherwise a chart may be one
    // patch if `patches` are few.
    bool compared = true;
    bool operator==(const Patching&) const = default;
};

class Patches {
public:
    // Throws InputError if there are no surfaces, or if `patches` is 0.
    Patches(const Geometry& geometry, const Patching& patching);

    // Patches twice as wide in both directions, if a chart has enough. point() must not be called on the result.
    Patches coarser() const;
    // For each patch, the coarser patch that contains it.
    std::vector<std::uint32_t> coarser_of_each(const Patches& coarser) const;

    std::size_t size() const { return patches_.size(); }
    double area(std::uint32_t patch) const { return patches_[patch].area; }
    const std::vector<Chart>& charts() const { return atlas_.charts(); }
    std::uint32_t chart_number(std::uint32_t patch) const { return patches_[patch].chart; }
    const Chart& chart(std::uint32_t patch) const { return charts()[chart_number(patch)]; }
    std::uint32_t chart_of(const SurfacePoint& p) const { return atlas_.chart_of(p); }
    // The larger of the numbers of cells along the two directions of a chart; for clusters, the root of their number.
    std::uint32_t cells_along(std::uint32_t chart) const;

    // The place of a point on its chart, which is the same for coarser patches.
    struct ChartPosition {
        std::uint32_t chart;
        Vec2 st;
        Region region;
    };
    // The place of a position on a chart that is not of clusters.
    ChartPosition place(std::uint32_t chart, const Vec3& position) const {
        const Vec2 st = charts()[chart].coordinates(*geometry_, position);
        return {chart, st, footprints_[chart].empty() ? Region() : footprints_[chart].region(st, position)};
    }
    ChartPosition place(const SurfacePoint& p) const {
        const std::uint32_t chart = chart_of(p);
        if (charts()[chart].clusters()) return {chart, charts()[chart].coordinates(*geometry_, p), Region()};
        return place(chart, p.position);
    }
    std::uint32_t locate(const ChartPosition& p) const {
        return locate(p.chart, p.st, [&] { return p.region; });
    }
    std::uint32_t locate(const SurfacePoint& p) const {
        const std::uint32_t number = chart_of(p);
        const Chart& chart = charts()[number];
        if (const FaceClusters* clusters = chart.clusters())
            return locate(number, {clusters->place(p.primitive), 0.5}, [] { return Region(); });
        const Vec2 st = chart.coordinates(*geometry_, p.position);
        return locate(number, st, [&] { return footprints_[number].region(st, p.position); });
    }
    // A point that is uniform by area if u is uniform in [0, 1)².
    SurfacePoint point(std::uint32_t number, const Vec2& u) const {
        const Patch& patch = patches_[number];
        const Chart& chart = charts()[patch.chart];
        return patch.part == whole ? chart.point(*geometry_, chart.uniform(patch.cell, u)) : point_of_part(patch, u);
    }
    // Such a point, made by Chart::bare_point().
    SurfacePoint bare_point(std::uint32_t number, const Vec2& u) const {
        const Patch& patch = patches_[number];
        const Chart& chart = charts()[patch.chart];
        return patch.part == whole ? chart.bare_point(*geometry_, chart.uniform(patch.cell, u)) : point_of_part(patch, u);
    }

    // Quadrilaterals that look like the patch; on a plane they cover it. A piece on an outline that divides a cell
    // belongs to the patch that has its middle. Not for the result of coarser().
    std::vector<std::array<Vec3, 4>> quadrilaterals(std::uint32_t number) const;

    // Linear interpolation between the values at the patches' centres, extrapolated to the chart's edge: the value at a point is
    // the sum of values times weights. There is no interpolation across charts, nor between clusters.
    struct Reading {
        std::array<std::uint32_t, 4> patch;
        std::array<double, 4> weight;
    };
    Reading interpolate(const ChartPosition& p) const;
    Reading interpolate(const SurfacePoint& p) const { return interpolate(place(p)); }

    const Geometry& geometry() const { return *geometry_; }

private:
    struct Axis {
        std::vector<double> ends, middles;  // ends and centres of the cells
        std::vector<std::uint32_t> first;   // lookup table: the first cell in each of equal parts of [0, 1]
        std::vector<double> next;           // start of the next cell; ∞ for the last cell, and two more ∞
        bool closed = false;                // periodic: the last cell is adjacent to the first
        std::uint32_t joined = 2;           // number of cells that are one coarser cell
    };
    struct Grid {
        Axis s, t;
        std::uint32_t first, first_patch;  // first cell and first patch of the chart
        bool whole = true;                 // no cell is divided into parts
    };
    // A cell, or the part of a cell that is in one region of Footprints.
    struct Patch {
        Cell cell;
        double area;
        std::uint32_t chart, part;
        Region region;
    };
    static constexpr std::uint32_t whole = ~std::uint32_t{0};

    struct Neighbours {
        std::uint32_t low, high;
        double weight;  // weight of `high`
    };
    Patches(const Geometry& geometry, const Patching& patching, const std::vector<ShapeArea>& areas);
    Patches(const Geometry& geometry, Atlas atlas, std::vector<Footprints> footprints)
        : geometry_(&geometry), atlas_(std::move(atlas)), footprints_(std::move(footprints)) {}

    static Axis axis(std::size_t cells, double grading, bool closed);
    static Axis axis(std::vector<double> ends, bool closed, std::uint32_t joined = 2);
    static Axis coarser(const Axis& axis);
    static std::uint32_t coarser_cell(const Axis& axis, std::uint32_t cell);
    static std::uint32_t size_of(const Axis& axis) { return static_cast<std::uint32_t>(axis.middles.size()); }
    static std::uint32_t cell(const Axis& axis, double x) {
        const auto parts = static_cast<double>(axis.first.size());
        std::uint32_t i = axis.first[static_cast<std::size_t>(std::clamp(x * parts, 0.0, parts - 1.0))];
        // One or two steps are nearly always enough, and additions avoid mispredicted branches.
        i += x >= axis.next[i];
        i += x >= axis.next[i];
        while (x >= axis.next[i]) ++i;
        return i;
    }
    std::uint32_t cell(std::uint32_t chart, const Vec2& st) const {
        const Grid& grid = grids_[chart];
        return grid.first + cell(grid.t, st.y) * size_of(grid.s) + cell(grid.s, st.x);
    }
    // Reads as few of the tables as possible, because they are large and accessed at random.
    template <class RegionAt>
    std::uint32_t locate(std::uint32_t chart, const Vec2& st, const RegionAt& region) const {
        const std::uint32_t c = cell(chart, st);
        if (const Grid& grid = grids_[chart]; grid.whole) return grid.first_patch + (c - grid.first);
        const std::uint32_t first = first_of_cell_[c];
        return first_of_cell_[c + 1] == first + 1 ? first : nearest(c, at_this_level(region()));
    }
    static Neighbours neighbours(const Axis& axis, double x);
    void add_grid(Axis s, Axis t);
    void add_cell(std::uint32_t chart, const Cell& cell, Parts parts);
    SurfacePoint point_of_part(const Patch& patch, const Vec2& u) const {
        return parts_[patch.part].point(*geometry_, charts()[patch.chart], footprints_[patch.chart], patch.cell, patch.region, u);
    }
    std::optional<std::uint32_t> find(std::uint32_t cell, Region region) const;
    std::uint32_t nearest(std::uint32_t cell, Region region) const;
    static Region coarser(Region region);
    Region at_this_level(Region region) const {
        for (std::uint32_t i = 0; i < times_coarser_; ++i) region = coarser(region);
        return region;
    }

    const Geometry* geometry_;
    Atlas atlas_;
    std::vector<Footprints> footprints_;  // one per chart
    std::vector<Grid> grids_;             // one per chart
    std::vector<std::uint32_t> first_of_cell_{0};
    std::vector<Patch> patches_;  // cell by cell
    std::vector<Part> parts_;
    std::uint32_t times_coarser_ = 0;
};

}  // namespace neumann
