// V(x, y) of many pairs of points, packet by packet: x is the end of a path, and y a sampled point on a light or on the
// lens, or a vertex of the other subpath.
#pragma once

#include "core/geometry/geometry.h"

#include <algorithm>
#include <cstdint>

namespace neumann {

// pair(k) returns references to the k-th pair; answer(k, seen) is called in order of k.
template <class Transport, class PairAt, class Found>
void test_visibility(const Transport& T, std::size_t count, RayCaster::Rays kind, const PairAt& pair, const Found& found) {
    for (std::size_t k = 0; k < count; k += RayCaster::packet_size) {
        const std::size_t n = std::min(RayCaster::packet_size, count - k);
        const std::uint32_t seen = T.visible(
            n, [&](std::size_t j) { return pair(k + j); }, kind);
        for (std::size_t j = 0; j < n; ++j) found(k + j, (seen >> j & 1u) != 0);
    }
}

}  // namespace neumann
