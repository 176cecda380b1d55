// Walks that advance together, one reflection at a time: R for all, then T for all, so that the processor always has several
// independent chains of arithmetic to work on.
#pragma once

#include "core/geometry/geometry.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace neumann {

template <class Walker>
void begin_together(std::vector<Walker>& walker, std::vector<std::uint32_t>& alive, std::size_t count) {
    walker.resize(count);
    alive.resize(count);
    std::iota(alive.begin(), alive.end(), 0u);
}

// Goes on with those of which f(walker, number) is true.
template <class Walker, class Keep>
void filter(std::vector<Walker>& walker, std::vector<std::uint32_t>& alive, const Keep& f) {
    std::size_t kept = 0;
    for (const std::uint32_t i : alive)
        if (f(walker[i], i)) alive[kept++] = i;
    alive.resize(kept);
}

// The same after asking T for the next points of as many walks at once as make a packet: ask(k, n, point) is that of
// alive[k … k + n), writes into point(j), and answers a bit for each. f(walker, number, found).
template <class Walker, class Point, class Ask, class Keep>
void advance(std::vector<Walker>& walker, std::vector<std::uint32_t>& alive, const Point& point_of, const Ask& ask, const Keep& f) {
    constexpr std::size_t packet = RayCaster::packet_size;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < alive.size(); k += packet) {
        const std::size_t n = std::min(packet, alive.size() - k);
        const std::uint32_t found = ask(k, n, [&](std::size_t j) -> SurfacePoint& { return point_of(walker[alive[k + j]]); });
        for (std::size_t j = 0; j < n; ++j) {
            const std::uint32_t i = alive[k + j];
            if (f(walker[i], i, (found >> j & 1u) != 0)) alive[kept++] = i;
        }
    }
    alive.resize(kept);
}

}  // namespace neumann
