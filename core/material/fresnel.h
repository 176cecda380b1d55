// The Fresnel reflectance of a conductor with refractive index η + ik for unpolarised light, for each colour channel separately
// (Born and Wolf, Principles of Optics, 14.2). With k = 0 it is that of a dielectric seen from outside, and with η = 0 it is 1.
#pragma once

#include "core/base/vec.h"

namespace neumann {

// F is in [0, 1] for η, k ≥ 0; cosθ > 0 is between the direction and the normal. With q = √(η² − sin²θ) = a + ib,
//
//     rs = (cosθ − q) / (cosθ + q),   rp = rs (q cosθ − sin²θ) / (q cosθ + sin²θ),   F = (|rs|² + |rp|²) / 2.
//
// Differences are formed before squaring, so F stays accurate if η is close to 1.
inline double conductor_fresnel(double cosine, double eta, double k) {
    if (eta == 0.0) return 1.0;
    const double cos2 = cosine * cosine, sin2 = 1.0 - cos2;
    const double re = (eta - 1.0) * (eta + 1.0) + cos2 - k * k, im = 2.0 * eta * k;
    const double larger = std::sqrt(0.5 * (std::sqrt(re * re + im * im) + std::abs(re)));
    const double smaller = larger > 0.0 ? 0.5 * im / larger : 0.0;
    const double a = re >= 0.0 ? larger : smaller, b = re >= 0.0 ? smaller : larger;
    const double rs = ((cosine - a) * (cosine - a) + b * b) / ((cosine + a) * (cosine + a) + b * b);
    const double ac = a * cosine, bc2 = b * b * cos2;
    const double rp_over_rs = ((ac - sin2) * (ac - sin2) + bc2) / ((ac + sin2) * (ac + sin2) + bc2);
    return 0.5 * rs * (1.0 + rp_over_rs);
}

class ConductorFresnel {
public:
    // A conductor that reflects everything.
    ConductorFresnel() = default;
    ConductorFresnel(const Rgb& eta, const Rgb& k) : eta_(eta), k_(k), perfect_(eta == Rgb(0.0)) {}

    Rgb operator()(double cosine) const {
        if (perfect_) return Rgb(1.0);
        return {conductor_fresnel(cosine, eta_.r, k_.r), conductor_fresnel(cosine, eta_.g, k_.g),
                conductor_fresnel(cosine, eta_.b, k_.b)};
    }
    bool is_grey() const { return perfect_ || (neumann::is_grey(eta_) && neumann::is_grey(k_)); }

private:
    Rgb eta_{0.0}, k_{1.0};
    bool perfect_ = true;
};

}  // namespace neumann
