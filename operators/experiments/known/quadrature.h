// Integrals over directions, for the laws of materials.
#pragma once

#include "core/material/bsdf.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace neumann::known {

template <int points = 31, class Function>
double integrate(double from, double to, double tolerance, const Function& f) {
    return boost::math::quadrature::gauss_kronrod<double, points>::integrate(f, from, to, 12, tolerance);
}

// Gauss quadrature with 10 intervals of 30 points, without an error estimate.
template <class Function>
double integrate_smooth(double from, double to, const Function& f) {
    double sum = 0.0;
    for (int i = 0; i < 10; ++i)
        sum += boost::math::quadrature::gauss<double, 30>::integrate(f, from + (to - from) * i / 10,
                                                                     from + (to - from) * (i + 1) / 10);
    return sum;
}

inline Vec3 at_cosine(double mu) { return {std::sqrt(1.0 - mu * mu), 0.0, mu}; }
inline constexpr double cosines[] = {1.0, 0.8, 0.5, 0.2, 0.05};

// ∫ f(ωi) dωi over the upper hemisphere, for an isotropic f seen from (sinθ, 0, cosθ). The interval is split at the highlight.
template <class Function>
double over_hemisphere(double mu, double tolerance, const Function& f) {
    const auto ring = [&](double z) {
        const double r = std::sqrt(1.0 - z * z);
        return 2.0 * integrate(0.0, pi, tolerance, [&](double phi) { return f(Vec3(-r * std::cos(phi), r * std::sin(phi), z)); });
    };
    return integrate(0.0, mu, tolerance, ring) + (mu < 1.0 ? integrate(mu, 1.0, tolerance, ring) : 0.0);
}
inline double albedo(const Bsdf& bsdf, double mu, int channel = 0, double tolerance = 1e-11) {
    return over_hemisphere(mu, tolerance, [&](const Vec3& wi) { return eval(bsdf, {}, at_cosine(mu), wi)[channel] * wi.z; });
}

}  // namespace neumann::known
