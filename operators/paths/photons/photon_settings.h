// The settings of photon maps.
#pragma once

#include <cmath>
#include <cstdint>

namespace neumann {

struct PhotonSettings {
    std::uint32_t paths = 0;  // number of paths from the lights in each pass
    // The radii of the first pass, in scene units: the largest one for photons that only delta lobes have reflected
    // (caustics), and the one for all others.
    double caustic_radius = 0.0, radius = 0.0;
    bool gather = false;  // one more reflection is sampled before the map is read
};

// Passes are independent, and their radii shrink so that the mean over n passes has a variance of order n^−α and a bias of order
// n^(α−1) (Knaus and Zwicker, Progressive Photon Mapping: A Probabilistic Approach, 2011):
//
//     r²_{i+1} / r²_i = (i + α) / (i + 1),   so that r²_i / r²_1 = Γ(i + α) / (Γ(1 + α) Γ(i + 1))
//
// With α = 2/3 the squared bias falls as fast as the variance.
constexpr double kept_variance = 2.0 / 3.0;  // α
// The radius of a pass, counted from 0, divided by that of the first.
inline double relative_radius(std::uint64_t pass) {
    const double i = static_cast<double>(pass) + 1.0;
    return std::exp(0.5 * (std::lgamma(i + kept_variance) - std::lgamma(1.0 + kept_variance) - std::lgamma(i + 1.0)));
}

}  // namespace neumann
