// Measures the largest albedo of a material that has no formula for it.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/sampling/warp.h"

namespace neumann {

// The largest mean weight of `sample(ωo, u)` over 2048 Hammersley points, among 12 angles and, for anisotropic materials, 3
// azimuths, plus 1%: the tests find no larger albedo in between.
template <class Sample>
Rgb measured_albedo(bool isotropic, const Sample& sample) {
    constexpr std::uint32_t count = 2048;
    Rgb largest(0.0);
    for (const double cosine : {1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05, 0.01})
        for (int azimuth = 0; azimuth < (isotropic ? 1 : 3); ++azimuth) {
            const double sine = std::sqrt(1.0 - cosine * cosine), phi = azimuth * pi / 4.0;
            const Vec3 wo(sine * std::cos(phi), sine * std::sin(phi), cosine);
            Rgb sum(0.0);
            for (std::uint32_t i = 0; i < count; ++i) {
                double inverse = 0.0, digit = 0.5;
                for (std::uint32_t rest = i; rest; rest >>= 1, digit *= 0.5) inverse += digit * (rest & 1u);
                sum += sample(wo, Vec2((i + 0.5) / count, inverse + 0.5 / count)).weight;
            }
            largest = glm::max(largest, sum * (1.01 / count));
        }
    return largest;
}

}  // namespace neumann
