// V(x, y) of many pairs of points, asked of T packet by packet: whether anything stands between a path's end and a point that was
// chosen, on a light, on the lens or on the path's other half.
#pragma once

#include "core/geometry/geometry.h"

#include <algorithm>
#include <cstdint>

namespace neumann {

// pair(k): the k-th, by reference; answer(k, seen) is told of them in order.
template <class Transport, class PairAt, class Answer>
void ask_visibility(const Transport& T, std::size_t count, RayCaster::Rays kind, const PairAt& pair, const Answer& answer) {
    for (std::size_t k = 0; k < count; k += RayCaster::packet_size) {
        const std::size_t n = std::min(RayCaster::packet_size, count - k);
        const std::uint32_t seen = T.visible(
            n, [&](std::size_t j) { return pair(k + j); }, kind);
        for (std::size_t j = 0; j < n; ++j) answer(k + j, (seen >> j & 1u) != 0);
    }
}

}  // namespace neumann
