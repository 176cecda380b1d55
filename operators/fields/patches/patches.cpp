#include "operators/fields/patches/patches.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

// How charts are cut into cells. `divides` cuts charts that are smaller than a cell, too, into four, so that coarser
// cells differ from finer ones on every chart.
struct Cutting {
    double width;
    bool divides;
};

// At least six, as a body has six sides.
constexpr std::size_t least_clusters = 6;

// The numbers of cells along the two directions of a chart.
std::array<std::size_t, 2> cells_of(const Chart& chart, const Cutting& cutting) {
    if (const std::size_t faces = chart.small_faces(); faces > 0) {
        const double area = chart.area({0.0, 1.0, 0.0, 1.0});
        const std::size_t least = std::min(cutting.divides ? least_clusters : 1, faces);
        return {std::clamp(static_cast<std::size_t>(std::lround(area / (cutting.width * cutting.width))), least, faces), 1};
    }
    const auto along = [&](double length) { return static_cast<std::size_t>(std::max(1.0, std::round(length / cutting.width))); };
    const Vec2 lengths = chart.lengths();
    // Around a pole at least three cells are needed.
    const std::array n{along(lengths.x), chart.closed_in_t() ? std::max<std::size_t>(3, along(lengths.y)) : along(lengths.y)};
    return cutting.divides && n[0] * n[1] == 1 ? std::array<std::size_t, 2>{2, 2} : n;
}

std::size_t count_cells(const std::vector<Chart>& charts, const Cutting& cutting) {
    std::size_t sum = 0;
    for (const Chart& chart : charts) {
        const auto n = cells_of(chart, cutting);
        sum += n[0] * n[1];
    }
    return sum;
}

// A surface divides a chart if it is closer than this part of a patch's width.
constexpr double near = 0.25;

// If the patches on the point's side of the outlines have less interpolation weight than this, there is no interpolation.
constexpr double least_weight = 0.5;

// The smallest width of cells for which there are at most `wanted` cells.
Cutting choose_cutting(const std::vector<Chart>& charts, double area, const Patching& patching) {
    const std::size_t wanted = patching.patches;
    const bool divides = patching.compared || 4 * charts.size() <= wanted;
    double high = 4.0 * std::sqrt(area), low = 0.25 * std::sqrt(area / static_cast<double>(wanted));
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        (count_cells(charts, {middle, divides}) <= wanted ? high : low) = middle;
    }
    return {high, divides};
}

}  // namespace

Patches::Patches(const Geometry& geometry, const Patching& patching) : Patches(geometry, patching, shape_areas(geometry)) {}

Patches::Patches(const Geometry& geometry, const Patching& patching, const std::vector<ShapeArea>& areas)
    : geometry_(&geometry), atlas_(geometry, areas, patching.patches) {
    if (patching.patches == 0) throw InputError("0 patches: at least one is needed");
    const double area = sum_of_areas(areas);
    if (area == 0.0) throw InputError("the scene has no surfaces, so there is nothing to cut into patches");
    const Cutting cutting = choose_cutting(charts(), area, patching);
    const auto cells = static_cast<double>(count_cells(charts(), cutting));
    footprints_ = find_footprints(geometry, charts(), near * std::sqrt(area / cells));
    for (std::uint32_t number = 0; number < charts().size(); ++number) {
        const Chart& chart = charts()[number];
        const auto [across, along] = cells_of(chart, cutting);
        if (chart.small_faces() > 0)
            add_grid(axis(atlas_.join(geometry, number, across).ends(), false, FaceClusters::joined), axis({0.0, 1.0}, false));
        else
            add_grid(axis(across, patching.grading, false), axis(along, patching.grading, chart.closed_in_t()));
    }
}

void Patches::add_grid(Axis s, Axis t) {
    const auto chart = static_cast<std::uint32_t>(grids_.size());
    Grid& grid = grids_.emplace_back(Grid{std::move(s), std::move(t), static_cast<std::uint32_t>(first_of_cell_.size()) - 1,
                                          static_cast<std::uint32_t>(patches_.size())});
    std::vector<Cell> cells;
    for (std::size_t j = 0; j < size_of(grid.t); ++j)
        for (std::size_t i = 0; i < size_of(grid.s); ++i)
            cells.push_back({grid.s.ends[i], grid.s.ends[i + 1], grid.t.ends[j], grid.t.ends[j + 1]});
    std::vector<Parts> parts(cells.size());
    if (!footprints_[chart].empty())
        oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
            parts[i] = find_parts(*geometry_, charts()[chart], footprints_[chart], cells[i]);
        });
    for (std::size_t i = 0; i < cells.size(); ++i) {
        grid.whole = grid.whole && parts[i].size() < 2;
        add_cell(chart, cells[i], std::move(parts[i]));
    }
}

void Patches::add_cell(std::uint32_t chart, const Cell& cell, Parts parts) {
    const double area = charts()[chart].area(cell);
    if (parts.size() < 2) {
        patches_.push_back({cell, area, chart, whole, parts.empty() ? Region() : parts.begin()->first});
    } else {
        for (auto& [region, part] : parts) {
            patches_.push_back({cell, area * part.share, chart, static_cast<std::uint32_t>(parts_.size()), region});
            parts_.push_back(std::move(part));
        }
    }
    first_of_cell_.push_back(static_cast<std::uint32_t>(patches_.size()));
}

// Coarser patches, twice as wide, have half as many bands.
Region Patches::coarser(Region region) {
    region.band = (region.band + 1) / 2;
    return region;
}

std::optional<std::uint32_t> Patches::find(std::uint32_t cell, Region region) const {
    for (std::uint32_t patch = first_of_cell_[cell]; patch < first_of_cell_[cell + 1]; ++patch)
        if (patches_[patch].region == region) return patch;
    return std::nullopt;
}

// The patch of a region in a cell, or the nearest one if the region is too small to be a patch.
std::uint32_t Patches::nearest(std::uint32_t cell, Region region) const {
    const auto distance = [&](std::uint32_t patch) {
        const Region r = patches_[patch].region;
        return std::pair(r.shapes != region.shapes, std::abs(static_cast<int>(r.band) - static_cast<int>(region.band)));
    };
    std::uint32_t best = first_of_cell_[cell];
    for (std::uint32_t patch = best + 1; patch < first_of_cell_[cell + 1]; ++patch)
        if (distance(patch) < distance(best)) best = patch;
    return best;
}

// A coarser cell has the parts of its finer cells, with the sums of their areas.
Patches Patches::coarser() const {
    Patches result(*geometry_, atlas_, footprints_);
    result.times_coarser_ = times_coarser_ + 1;
    for (std::uint32_t chart = 0; chart < grids_.size(); ++chart) {
        const Grid& grid = grids_[chart];
        const Axis s = coarser(grid.s), t = coarser(grid.t);
        std::vector<std::map<Region, double>> area_of_region(std::size_t{size_of(s)} * size_of(t));
        for (std::uint32_t j = 0; j < size_of(grid.t); ++j)
            for (std::uint32_t i = 0; i < size_of(grid.s); ++i) {
                const std::uint32_t fine = grid.first + j * size_of(grid.s) + i;
                auto& areas = area_of_region[coarser_cell(grid.t, j) * size_of(s) + coarser_cell(grid.s, i)];
                for (std::uint32_t patch = first_of_cell_[fine]; patch < first_of_cell_[fine + 1]; ++patch)
                    areas[coarser(patches_[patch].region)] += patches_[patch].area;
            }
        Grid& coarse = result.grids_.emplace_back(Grid{s, t, static_cast<std::uint32_t>(result.first_of_cell_.size()) - 1,
                                                       static_cast<std::uint32_t>(result.patches_.size())});
        for (std::uint32_t j = 0; j < size_of(t); ++j)
            for (std::uint32_t i = 0; i < size_of(s); ++i) {
                const Cell cell{s.ends[i], s.ends[i + 1], t.ends[j], t.ends[j + 1]};
                coarse.whole = coarse.whole && area_of_region[j * size_of(s) + i].size() < 2;
                for (const auto& [region, area] : area_of_region[j * size_of(s) + i])
                    result.patches_.push_back({cell, area, chart, whole, region});
                result.first_of_cell_.push_back(static_cast<std::uint32_t>(result.patches_.size()));
            }
    }
    return result;
}

std::vector<std::uint32_t> Patches::coarser_of_each(const Patches& coarse) const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t chart = 0; chart < grids_.size(); ++chart) {
        const Grid &grid = grids_[chart], &around = coarse.grids_[chart];
        for (std::uint32_t j = 0; j < size_of(grid.t); ++j)
            for (std::uint32_t i = 0; i < size_of(grid.s); ++i) {
                const std::uint32_t fine = grid.first + j * size_of(grid.s) + i;
                const std::uint32_t cell = around.first + coarser_cell(grid.t, j) * size_of(around.s) + coarser_cell(grid.s, i);
                for (std::uint32_t patch = first_of_cell_[fine]; patch < first_of_cell_[fine + 1]; ++patch)
                    result.push_back(*coarse.find(cell, coarser(patches_[patch].region)));
            }
    }
    return result;
}

std::uint32_t Patches::cells_along(std::uint32_t chart) const {
    const std::uint32_t along_s = size_of(grids_[chart].s), along_t = size_of(grids_[chart].t);
    if (charts()[chart].clusters()) return static_cast<std::uint32_t>(std::ceil(std::sqrt(along_s)));
    return std::max(along_s, along_t);
}

Patches::Axis Patches::axis(std::size_t cells, double grading, bool closed) {
    std::vector<double> ends;
    for (std::size_t i = 0; i <= cells; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(cells);
        ends.push_back(closed ? x : x + grading * x * (1.0 - x) * (2.0 * x - 1.0));
    }
    return axis(std::move(ends), closed);
}

Patches::Axis Patches::axis(std::vector<double> ends, bool closed, std::uint32_t joined) {
    Axis axis{std::move(ends), {}, {}, {}, closed, joined};
    for (std::size_t i = 0; i + 1 < axis.ends.size(); ++i) axis.middles.push_back(0.5 * (axis.ends[i] + axis.ends[i + 1]));
    const std::size_t parts = 2 * axis.middles.size();
    for (std::size_t k = 0, i = 0; k < parts; ++k) {
        while (i + 1 < axis.middles.size() && axis.ends[i + 1] * static_cast<double>(parts) < static_cast<double>(k)) ++i;
        axis.first.push_back(static_cast<std::uint32_t>(i));
    }
    axis.next.assign(axis.ends.begin() + 1, axis.ends.end() - 1);
    axis.next.resize(axis.next.size() + 3, std::numeric_limits<double>::infinity());
    return axis;
}

// Joins pairs of cells, or groups of four clusters; what is left over belongs to the last ones.
Patches::Axis Patches::coarser(const Axis& fine) {
    std::vector<double> ends{fine.ends.front()};
    for (std::uint32_t i = 1; i < size_of(fine); ++i)
        if (coarser_cell(fine, i) != coarser_cell(fine, i - 1)) ends.push_back(fine.ends[i]);
    ends.push_back(fine.ends.back());
    return axis(std::move(ends), fine.closed, fine.joined);
}

std::uint32_t Patches::coarser_cell(const Axis& axis, std::uint32_t cell) {
    return std::min(cell / axis.joined, std::max(size_of(axis) / axis.joined, 1u) - 1);
}

Patches::Neighbours Patches::neighbours(const Axis& axis, double x) {
    const std::uint32_t n = size_of(axis);
    if (n == 1) return {0, 0, 0.0};
    const std::uint32_t i = cell(axis, x);
    const bool after = x >= axis.middles[i];
    if (axis.closed) {
        const std::uint32_t low = after ? i : (i + n - 1) % n, high = (low + 1) % n;
        const auto distance = [](double from, double to) { return to - from - std::floor(to - from); };
        return {low, high, distance(axis.middles[low], x) / distance(axis.middles[low], axis.middles[high])};
    }
    const std::uint32_t low = std::min(after ? i : (i > 0 ? i - 1 : 0), n - 2);
    return {low, low + 1, (x - axis.middles[low]) / (axis.middles[low + 1] - axis.middles[low])};
}

std::vector<std::array<Vec3, 4>> Patches::quadrilaterals(std::uint32_t number) const {
    constexpr std::uint32_t round_along = 4;
    const Patch& patch = patches_[number];
    const Chart& chart = charts()[patch.chart];
    const Part* const part = patch.part == whole ? nullptr : &parts_[patch.part];
    const std::uint32_t along = part ? part->along : chart.is_plane() ? 1 : round_along;
    const auto coordinates = [&](double x, double y) { return chart.uniform(patch.cell, Vec2(x, y) / double(along)); };
    const auto position = [&](double x, double y) { return chart.point(*geometry_, coordinates(x, y)).position; };
    std::vector<std::array<Vec3, 4>> found;
    if (chart.clusters()) {
        for (const std::uint32_t face : chart.clusters()->faces(patch.cell.s0, patch.cell.s1)) {
            const auto [a, b, c] = corners_of(geometry_->shapes()[chart.shape()], face).at;
            found.push_back({a, b, c, c});
        }
        return found;
    }
    const auto add = [&](double x, double y) {
        found.push_back({position(x, y), position(x + 1.0, y), position(x + 1.0, y + 1.0), position(x, y + 1.0)});
    };
    if (!part) {
        for (std::uint32_t i = 0; i < along * along; ++i) add(i % along, i / along);
        return found;
    }
    for (const std::uint16_t square : part->squares) {
        const double x = square % along, y = square / along;
        const Vec2 middle = coordinates(x + 0.5, y + 0.5);
        if (footprints_[patch.chart].region(middle, chart.point(*geometry_, middle).position) == patch.region) add(x, y);
    }
    return found;
}

Patches::Reading Patches::interpolate(const ChartPosition& p) const {
    if (charts()[p.chart].clusters()) {
        const std::uint32_t own = locate(p);
        return {{own, own, own, own}, {1.0, 0.0, 0.0, 0.0}};
    }
    const Grid& grid = grids_[p.chart];
    const Neighbours s = neighbours(grid.s, p.st.x), t = neighbours(grid.t, p.st.y);
    const std::uint32_t n = size_of(grid.s);
    Reading reading{
        {grid.first + t.low * n + s.low, grid.first + t.low * n + s.high, grid.first + t.high * n + s.low,
         grid.first + t.high * n + s.high},
        {(1.0 - t.weight) * (1.0 - s.weight), (1.0 - t.weight) * s.weight, t.weight * (1.0 - s.weight), t.weight * s.weight}};
    if (footprints_[p.chart].empty()) {
        for (std::uint32_t& patch : reading.patch) patch = first_of_cell_[patch];
        return reading;
    }
    // Interpolates only between patches on the same side of all outlines. If their weight is too small, and in bands, the value of
    // the point's own patch is used.
    const Region region = at_this_level(p.region);
    double left = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto found = find(reading.patch[i], region);
        reading.patch[i] = found.value_or(first_of_cell_[reading.patch[i]]);
        if (found)
            left += reading.weight[i];
        else
            reading.weight[i] = 0.0;
    }
    if (left < least_weight || region.band > 0) {
        const std::uint32_t own = locate(p);
        return {{own, own, own, own}, {1.0, 0.0, 0.0, 0.0}};
    }
    for (double& weight : reading.weight) weight /= left;
    return reading;
}

}  // namespace neumann
