// Finds the paths at which chains start once more, because only sums of f over groups of paths are kept (chain_starts.h).
#pragma once

#include "operators/paths/metropolis/chain_starts.h"
#include "operators/paths/metropolis/independent_paths.h"

#include <cmath>
#include <span>
#include <vector>

namespace neumann {

// Traces a group of a replicate's independent paths again and calls take(wanted, start) for each of the `wanted` starts
// in it; these are sorted by bounce and `left`. Adds the rays of each bounce to `rays`.
template <class Take>
void find_starts_of_group(const IndependentPaths& paths, std::uint64_t replicate, std::span<const WantedStart> wanted,
                          IndependentPaths::Workspace& work, std::span<std::uint64_t> rays, const Take& take) {
    struct OfBounce {
        std::span<const WantedStart> waiting;
        double before = 0.0;
        ChainStart last;
    };
    std::vector<OfBounce> bounces(static_cast<std::size_t>(wanted.back().bounce) + 1);
    for (std::size_t begin = 0, end = 0; begin < wanted.size(); begin = end) {
        while (end < wanted.size() && wanted[end].bounce == wanted[begin].bounce) ++end;
        bounces[static_cast<std::size_t>(wanted[begin].bounce)].waiting = wanted.subspan(begin, end - begin);
    }
    const auto take_first = [&](OfBounce& of) {
        take(of.waiting.front(), of.last);
        of.waiting = of.waiting.subspan(1);
    };
    (void)paths.trace_group(
        replicate, wanted[0].group, work,
        [&](std::uint32_t i, const WayFound& found) {
            const auto bounce = static_cast<std::size_t>(found.bounce);
            const double size = size_of(found.value);
            if (bounce >= bounces.size() || !std::isfinite(size)) return;
            OfBounce& of = bounces[bounce];
            of.before += size;
            of.last = {wanted[0].group * chains_at_once + i, found.s};
            while (!of.waiting.empty() && of.waiting.front().left < of.before) take_first(of);
        },
        rays);
    for (OfBounce& of : bounces)
        while (!of.waiting.empty()) take_first(of);  // rounding may lead past the end
}

}  // namespace neumann
