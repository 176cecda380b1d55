// The clear sky of Hošek and Wilkie, An Analytic Model for Full Spectral Sky-Dome Radiance, SIGGRAPH 2012:
//
//     L(θ, γ) = M (1 + A e^(B / (cosθ + 0.01))) (C + D e^(Eγ) + F cos²γ + G χ(H, γ) + I √cosθ),
//     χ(H, γ) = (1 + cos²γ) / (1 + H² − 2 H cosγ)^(3/2),
//
// at the angle θ from the zenith and γ from the sun. M and A to I are quintic Bézier curves over the cube root of the sun's
// elevation over π/2, and linear in the turbidity and in the albedo of the ground.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <vector>

namespace neumann {

class SkyModel {
public:
    // `turbidity`: 1 to 10. `albedo`: 0 to 1. `elevation` of the sun: 0 to π/2.
    SkyModel(double turbidity, const Rgb& albedo, double elevation);

    // Linear sRGB, W·m⁻²·sr⁻¹·nm⁻¹, averaged as radiance_to_rgb() does; for cosθ ≥ 0. What is outside of sRGB is cut to it.
    Rgb radiance(double cos_theta, double cos_gamma) const;
    // An upper bound of radiance(), by intervals of 1°.
    Rgb largest() const;

private:
    struct Coefficients {
        double A, B, C, D, E, F, G, I, H, M;
    };
    using Channels = std::array<Coefficients, 3>;  // for each of X, Y, Z
    template <class Number>
    static Number radiance(const Coefficients& k, const Number& cos_theta, const Number& gamma, const Number& cos_gamma);

    double elevation_;
    // There is one for each channel of sRGB, or a single one if the albedo is grey: a channel depends on the albedo in
    // its own wavelengths.
    std::vector<Channels> of_albedo_;
};

}  // namespace neumann
