#include "operators/paths/metropolis/chain_starts.h"

#include <algorithm>
#include <tuple>

namespace neumann {

double BrightnessSums::total(std::size_t bounce) const {
    double all = 0.0;
    for (std::uint32_t group = 0; group < groups(); ++group) all += of(group, bounce);
    return all;
}

std::vector<WantedStart> choose_starts(const BrightnessSums& sums, std::uint32_t chains, std::span<const double> u) {
    std::vector<WantedStart> all;
    for (std::size_t bounce = 1; bounce < sums.bounces(); ++bounce) {
        const double total = sums.total(bounce);
        if (!(total > 0.0)) continue;
        std::uint32_t group = 0, last = 0;  // last is the last group before this one that has light
        double before = 0.0;
        for (std::uint32_t chain = 0; chain < chains; ++chain) {
            const double at = total * ((chain + u[bounce]) / chains);
            while (group < sums.groups() && !(at < before + sums.of(group, bounce))) {
                if (sums.of(group, bounce) > 0.0) last = group;
                before += sums.of(group, bounce);
                ++group;
            }
            // Rounding may lead past the end.
            const bool is_past = group == sums.groups();
            all.push_back({is_past ? last : group, chain, static_cast<int>(bounce), is_past ? total : at - before});
        }
    }
    std::sort(all.begin(), all.end(), [](const WantedStart& a, const WantedStart& b) {
        return std::tie(a.group, a.bounce, a.left, a.chain) < std::tie(b.group, b.bounce, b.left, b.chain);
    });
    return all;
}

}  // namespace neumann
