#include "operators/patches/patches.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

double total_area(const Geometry& geometry) {
    double sum = 0.0;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) sum += geometry.area(shape);
    return sum;
}

double positive_area(const Geometry& geometry) {
    const double area = total_area(geometry);
    if (area == 0.0) throw InputError("the scene has no surfaces, so there is nothing to cut into patches");
    return area;
}

// Cells along the two directions of a chart, for cells of a given width.
std::array<std::size_t, 2> cells_of(const Chart& chart, double width) {
    const auto along = [&](double length) { return static_cast<std::size_t>(std::max(1.0, std::round(length / width))); };
    const Vec2 lengths = chart.lengths();
    // Around a pole a few cells are needed whatever the size.
    return {along(lengths.x), chart.closed_in_t() ? std::max<std::size_t>(3, along(lengths.y)) : along(lengths.y)};
}

std::size_t count_cells(const std::vector<Chart>& charts, double width) {
    std::size_t sum = 0;
    for (const Chart& chart : charts) {
        const auto n = cells_of(chart, width);
        sum += n[0] * n[1];
    }
    return sum;
}

// The smallest width that needs no more cells than wanted.
double choose_width(const std::vector<Chart>& charts, double area, std::size_t wanted) {
    double high = 4.0 * std::sqrt(area), low = 0.25 * std::sqrt(area / static_cast<double>(wanted));
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        (count_cells(charts, middle) <= wanted ? high : low) = middle;
    }
    return high;
}

}  // namespace

Patches::Patches(const Geometry& geometry, const Patching& patching)
    : geometry_(&geometry),
      atlas_(geometry, positive_area(geometry) / static_cast<double>(std::max<std::size_t>(patching.patches, 1))) {
    if (patching.patches == 0) throw InputError("0 patches: at least one is needed");
    const double width = choose_width(charts(), total_area(geometry), patching.patches);
    for (const Chart& chart : charts()) {
        const auto [across, along] = cells_of(chart, width);
        add_grid(axis(across, patching.grading, false), axis(along, patching.grading, chart.closed_in_t()));
    }
}

void Patches::add_grid(Axis s, Axis t) {
    const auto number = static_cast<std::uint32_t>(grids_.size());
    const Grid& grid = grids_.emplace_back(Grid{std::move(s), std::move(t), static_cast<std::uint32_t>(cells_.size())});
    for (std::size_t j = 0; j < size_of(grid.t); ++j)
        for (std::size_t i = 0; i < size_of(grid.s); ++i) {
            const Cell cell{grid.s.ends[i], grid.s.ends[i + 1], grid.t.ends[j], grid.t.ends[j + 1]};
            cells_.push_back(cell);
            areas_.push_back(charts()[number].area(cell));
            chart_of_.push_back(number);
        }
}

Patches Patches::coarser() const {
    Patches result(*geometry_, atlas_);
    for (const Grid& grid : grids_) result.add_grid(coarser(grid.s), coarser(grid.t));
    return result;
}

std::vector<std::uint32_t> Patches::coarser_of_each() const {
    std::vector<std::uint32_t> result;
    std::uint32_t first = 0;
    for (const Grid& grid : grids_) {
        const std::uint32_t across = size_of(coarser(grid.s)), along = size_of(coarser(grid.t));
        for (std::uint32_t j = 0; j < size_of(grid.t); ++j)
            for (std::uint32_t i = 0; i < size_of(grid.s); ++i)
                result.push_back(first + coarser_cell(grid.t, j) * across + coarser_cell(grid.s, i));
        first += across * along;
    }
    return result;
}

Patches::Axis Patches::axis(std::size_t cells, double grading, bool closed) {
    std::vector<double> ends;
    for (std::size_t i = 0; i <= cells; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(cells);
        ends.push_back(closed ? x : x + grading * x * (1.0 - x) * (2.0 * x - 1.0));
    }
    return axis(std::move(ends), closed);
}

Patches::Axis Patches::axis(std::vector<double> ends, bool closed) {
    Axis axis{std::move(ends), {}, closed};
    for (std::size_t i = 0; i + 1 < axis.ends.size(); ++i) axis.middles.push_back(0.5 * (axis.ends[i] + axis.ends[i + 1]));
    return axis;
}

// Pairs of cells; of an odd number the last three are one.
Patches::Axis Patches::coarser(const Axis& fine) {
    std::vector<double> ends{fine.ends.front()};
    for (std::uint32_t i = 1; i < size_of(fine); ++i)
        if (coarser_cell(fine, i) != coarser_cell(fine, i - 1)) ends.push_back(fine.ends[i]);
    ends.push_back(fine.ends.back());
    return axis(std::move(ends), fine.closed);
}

std::uint32_t Patches::coarser_cell(const Axis& axis, std::uint32_t cell) {
    return std::min(cell / 2, std::max(size_of(axis) / 2, 1u) - 1);
}

std::uint32_t Patches::cell(const Axis& axis, double x) {
    const auto above = std::upper_bound(axis.ends.begin() + 1, axis.ends.end() - 1, x);
    return static_cast<std::uint32_t>(above - axis.ends.begin()) - 1;
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

Patches::Reading Patches::interpolate(const SurfacePoint& p) const {
    const std::uint32_t chart = atlas_.chart_of(p);
    const Vec2 st = charts()[chart].coordinates(*geometry_, p.position);
    const Grid& grid = grids_[chart];
    const Neighbours s = neighbours(grid.s, st.x), t = neighbours(grid.t, st.y);
    const std::uint32_t n = size_of(grid.s);
    return {{grid.first + t.low * n + s.low, grid.first + t.low * n + s.high, grid.first + t.high * n + s.low,
             grid.first + t.high * n + s.high},
            {(1.0 - t.weight) * (1.0 - s.weight), (1.0 - t.weight) * s.weight, t.weight * (1.0 - s.weight), t.weight * s.weight}};
}

}  // namespace neumann
