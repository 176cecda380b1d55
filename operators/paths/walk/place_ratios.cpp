#include "operators/paths/walk/place_ratios.h"

#include <algorithm>
#include <cmath>

namespace neumann {

PlaceRatios::PlaceRatios(PlaceCells cells, int bounces, const std::unordered_map<Key, Moments>& learned, double rays_by_variance,
                         double dark)
    : cells_(cells), bounces_(bounces), dark_(dark) {
    for (const auto& [key, m] : learned) {
        const auto factor = [&, rays = m.rays](double moment) {
            return static_cast<float>(std::sqrt(moment / rays * rays_by_variance));
        };
        factors_.emplace(key, Factors{factor(m.second), factor(m.variance), static_cast<float>(m.mean)});
    }
}

double PlaceRatios::light(const Walker& w) const {
    const auto found = factors_.find(key(1, w));
    return (found == factors_.end() ? 0.0 : glm::length(w.beta) * found->second.light) + dark_;
}

double PlaceRatios::at(int bounce, const Walker& w, double light) const {
    if (bounce > bounces_) return 1.0;
    const auto found = factors_.find(key(bounce, w));
    if (found == factors_.end()) return 1.0;
    const double weight = glm::length(w.beta) / light, roulette = weight * found->second.of_roulette,
                 splitting = weight * found->second.of_splitting;
    if (roulette < 1.0) return std::max(roulette, least_branches);
    return std::round(std::clamp(splitting, 1.0, largest_branches));
}

PlaceRatios::Key PlaceRatios::key(int bounce, const Walker& w) const {
    constexpr int alike = 2;  // with this many reflections or more to follow, light is about the same
    const auto left = static_cast<std::uint64_t>(std::min(bounces_ - bounce, alike));
    const std::uint64_t octant = (w.wo.x > 0.0) | (w.wo.y > 0.0) << 1 | (w.wo.z > 0.0) << 2;
    return cells_.cell(w.x.position, left << 3 | octant);
}

}  // namespace neumann
