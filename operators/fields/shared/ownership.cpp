#include "operators/fields/shared/ownership.h"

#include "operators/fields/matrix/ray_table.h"

#include <glm/gtc/bitfield.hpp>

#include <algorithm>
#include <numeric>

namespace neumann {

namespace {

// The place of each patch in Morton's order.
std::vector<std::uint64_t> morton_codes(const Patches& patches) {
    std::vector<Vec3> centres;
    Vec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (std::uint32_t p = 0; p < patches.size(); ++p) {
        centres.push_back(patches.point(p, Vec2(0.5)).position);
        low = glm::min(low, centres.back());
        high = glm::max(high, centres.back());
    }
    constexpr double most = (1 << 20) - 1;
    const Vec3 size = high - low;
    const double scale = most / std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    std::vector<std::uint64_t> codes;
    for (const Vec3& centre : centres) {
        const Vec3 at = (centre - low) * scale;
        codes.push_back(glm::bitfieldInterleave(static_cast<glm::uint32>(at.x), static_cast<glm::uint32>(at.y),
                                                static_cast<glm::uint32>(at.z)));
    }
    return codes;
}

}  // namespace

Ownership share_out(const PatchSpace& space, std::uint32_t rays, int processes, int rank) {
    const std::vector<std::uint64_t> codes = morton_codes(space.patches());
    std::vector<std::uint32_t> order(codes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t patch) { return codes[patch]; });

    const auto facets = static_cast<std::uint32_t>(space.facets().size());
    std::vector<int> owner(facets);
    const double all = static_cast<double>(RayTable::size(space, rays));
    double before = 0.0;
    for (const std::uint32_t patch : order) {
        double here = 0.0;
        for (const bool front : {true, false})
            if (const std::uint32_t f = space.facet(patch, front); f < facets) {
                owner[f] = std::min(static_cast<int>(before / all * processes), processes - 1);
                here += rays_of(space.facets()[f], rays);
            }
        before += here;
    }

    Ownership shared;
    shared.first.assign(static_cast<std::size_t>(processes) + 1, 0);
    for (std::uint32_t f = 0; f < facets; ++f) {
        shared.first[static_cast<std::size_t>(owner[f]) + 1] += space.facets()[f].cells.size();
        if (owner[f] == rank) shared.facets.push_back(f);
    }
    std::partial_sum(shared.first.begin(), shared.first.end(), shared.first.begin());
    std::vector<std::uint32_t> next(shared.first);
    shared.number.resize(space.size());
    for (std::uint32_t f = 0; f < facets; ++f) {
        const Facet& facet = space.facets()[f];
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
            shared.number[u] = next[static_cast<std::size_t>(owner[f])]++;
    }
    return shared;
}

}  // namespace neumann
