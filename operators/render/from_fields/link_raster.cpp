#include "operators/render/from_fields/link_raster.h"

#include <oneapi/tbb/parallel_sort.h>
#include <algorithm>
#include <bit>
#include <tuple>

namespace neumann {

namespace {

std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}
std::uint32_t gather_bits(std::uint32_t x) {
    x &= 0x55555555u;
    x = (x | x >> 1) & 0x33333333u;
    x = (x | x >> 2) & 0x0f0f0f0fu;
    x = (x | x >> 4) & 0x00ff00ffu;
    return (x | x >> 8) & 0xffffu;
}

}  // namespace

Vec2 LinkRaster::spread(const Chart& chart, const Vec2& st) {
    if (!chart.clusters()) return st;
    constexpr double places = 1u << 2 * levels, along = 1u << levels;
    const auto k = static_cast<std::uint32_t>(std::clamp(st.x * places, 0.0, places - 1.0));
    return Vec2(gather_bits(k) + 0.5, gather_bits(k >> 1) + 0.5) / along;
}

// The index along a Morton curve over the chart's finest cells.
std::uint32_t LinkRaster::place(const Vec2& st) {
    constexpr double n = 1u << levels;
    const auto cell = [&](double x) { return static_cast<std::uint32_t>(std::clamp(x * n, 0.0, n - 1.0)); };
    return spread_bits(cell(st.x)) | spread_bits(cell(st.y)) << 1;
}

LinkRaster::End::End(std::uint32_t chart, bool front, const Vec2& st, std::uint32_t bounce, const Rgb& power)
    : side(2 * chart + (front ? 0 : 1)),
      place(LinkRaster::place(st)),
      bounce(bounce),
      power{static_cast<float>(power.r), static_cast<float>(power.g), static_cast<float>(power.b)} {}

LinkRaster::LinkRaster(const Patches& patches, std::vector<End> ends, int bounces)
    : fine_{3 * static_cast<std::size_t>(std::max(bounces, 1))}, coarse_(fine_) {
    // The key is everything about an end, so that the order of equal ends does not matter and sums are deterministic.
    oneapi::tbb::parallel_sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
        return std::tie(a.side, a.place, a.bounce, a.power) < std::tie(b.side, b.place, b.bounce, b.power);
    });
    const auto sides = static_cast<std::uint32_t>(2 * patches.charts().size());
    for (const auto& [cells, enough] : {std::pair(&fine_, enough_ends), std::pair(&coarse_, 4 * enough_ends)}) {
        const std::uint32_t coarser = cells == &coarse_ ? 1 : 0;
        auto from = ends.begin();
        for (std::uint32_t side = 0; side < sides; ++side) {
            cells->first.push_back(cells->begin.size());
            const auto to = std::find_if(from, ends.end(), [&](const End& end) { return end.side != side; });
            const auto as_patches = static_cast<std::uint32_t>(std::bit_width(patches.cells_along(side / 2) - 1));
            const std::uint32_t least = as_patches > coarser ? std::min(as_patches, levels) - coarser : 0;
            cells->divide({from, to}, enough, least, patches.charts()[side / 2], 0, 0);
            from = to;
        }
        cells->first.push_back(cells->begin.size());
    }
}

// Cells with any ends are divided at least to the level `least`.
void LinkRaster::Cells::divide(std::span<const End> ends, std::size_t enough, std::uint32_t least, const Chart& chart,
                               std::uint32_t from, std::uint32_t level) {
    const bool divides = level < least ? !ends.empty() : ends.size() >= enough && level < levels;
    if (!divides) {
        add(ends, chart, from, level);
        return;
    }
    const std::uint32_t quarter = 1u << 2 * (levels - level - 1);
    auto begun = ends.begin();
    for (std::uint32_t q = 1; q <= 4; ++q) {
        const auto end = std::partition_point(begun, ends.end(), [&](const End& e) { return e.place < from + q * quarter; });
        divide({begun, end}, enough, least, chart, from + (q - 1) * quarter, level + 1);
        begun = end;
    }
}

void LinkRaster::Cells::add(std::span<const End> ends, const Chart& chart, std::uint32_t from, std::uint32_t level) {
    std::vector<double> sums(stride);
    for (const End& end : ends)
        for (std::size_t c = 0; c < 3; ++c) sums[3 * (end.bounce - 2) + c] += double{end.power[c]};
    constexpr double finest = 1.0 / (1u << levels);
    const double size = 1.0 / (1u << level), s = gather_bits(from) * finest, t = gather_bits(from >> 1) * finest;
    const double etendue = pi * chart.area({s, s + size, t, t + size});
    begin.push_back(from);
    for (const double sum : sums) values.push_back(etendue > 0.0 ? static_cast<float>(sum / etendue) : 0.0f);
}

std::span<const float> LinkRaster::Cells::read(std::size_t side, std::uint32_t place) const {
    const auto from = begin.begin() + static_cast<std::ptrdiff_t>(first[side]),
               to = begin.begin() + static_cast<std::ptrdiff_t>(first[side + 1]);
    const auto cell = static_cast<std::size_t>(std::upper_bound(from, to, place) - begin.begin()) - 1;
    return {values.data() + cell * stride, stride};
}

void LinkRaster::set_to_zero(std::size_t bounce) {
    for (Cells* cells : {&fine_, &coarse_})
        for (std::size_t i = 3 * (bounce - 2); i < cells->values.size(); i += cells->stride)
            std::fill_n(cells->values.data() + i, 3, 0.0f);
}

}  // namespace neumann
