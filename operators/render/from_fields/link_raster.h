// The incident radiance of light that comes by links (operators/fields/matrix/link_light.h) to diffuse sides, on cells
// of each chart. It is read where such a side is seen in a mirror or through glass. Cells are quartered as long as
// enough paths end there, so that caustics stay sharp, and in any case until they are about as small as patches.
#pragma once

#include "core/base/vec.h"
#include "operators/fields/patches/patches.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

class LinkRaster {
public:
    // A cell that is no larger than a patch is divided if at least this many paths end there.
    static constexpr std::size_t enough_ends = 256;

    // The end of a path.
    struct End {
        std::uint32_t side;  // 2 · chart, + 1 for the back
        std::uint32_t place;
        std::uint32_t bounce;
        std::array<float, 3> power;  // W
        End() = default;
        End(std::uint32_t chart, bool front, const Vec2& st, std::uint32_t bounce, const Rgb& power);
    };
    // Maps coordinates on a chart to those of ends and readings. Clusters of faces follow one another along s alone;
    // this lays them along a Morton curve through the square, so that each quarter of a cell is a range of clusters.
    static Vec2 spread(const Chart& chart, const Vec2& st);
    // Takes bounces 2 … N + 1; the last one contains all later ones.
    LinkRaster(const Patches& patches, std::vector<End> ends, int bounces);

    // The incident radiance in bounce 2, 3, …, three floats each: the mean over a cell, and over a cell of about four
    // times the size. The two are the same only on a chart that is one patch.
    struct Reading {
        std::span<const float> fine, coarse;
    };
    void set_to_zero(std::size_t bounce);
    Reading read(std::uint32_t chart, bool front, const Vec2& st) const {
        const std::size_t side = 2 * std::size_t{chart} + (front ? 0 : 1);
        return {fine_.read(side, place(st)), coarse_.read(side, place(st))};
    }

private:
    static constexpr std::uint32_t levels = 14;  // a chart has at most 2^levels cells along each axis
    static std::uint32_t place(const Vec2& st);

    // A division of all sides into cells.
    struct Cells {
        std::size_t stride;
        std::vector<std::size_t> first = {};    // first cell of each side, and the end
        std::vector<std::uint32_t> begin = {};  // where each cell begins on the curve
        std::vector<float> values = {};

        void divide(std::span<const End> ends, std::size_t enough, std::uint32_t least, const Chart& chart, std::uint32_t from,
                    std::uint32_t level);
        void add(std::span<const End> ends, const Chart& chart, std::uint32_t from, std::uint32_t level);
        std::span<const float> read(std::size_t side, std::uint32_t place) const;
    };
    Cells fine_, coarse_;
};

}  // namespace neumann
