#include "core/image/colour/spectrum_to_rgb.h"

#include "core/image/colour/cie.h"

#include <algorithm>

namespace neumann {

namespace {

double value_at(const SpectrumTable& s, double wavelength) {
    if (wavelength < s.wavelengths.front() || wavelength > s.wavelengths.back()) return 0.0;
    const auto next = std::upper_bound(s.wavelengths.begin(), s.wavelengths.end(), wavelength);
    if (next == s.wavelengths.end()) return s.values.back();
    const auto i = static_cast<std::size_t>(next - s.wavelengths.begin());
    const double t = (wavelength - s.wavelengths[i - 1]) / (s.wavelengths[i] - s.wavelengths[i - 1]);
    return s.values[i - 1] + t * (s.values[i] - s.values[i - 1]);
}

struct Weights {
    Vec3 xyz;
    double light;
};

Weights weights_at(double wavelength, Illuminant illuminant) {
    const double place = (wavelength - cie::first_wavelength) / cie::step;
    const int i = std::clamp(static_cast<int>(place), 0, cie::count - 2);
    const double t = place - i;
    const auto lerp = [t](double a, double b) { return a + t * (b - a); };
    const auto &a = cie::observer_1931[i], &b = cie::observer_1931[i + 1];
    const double light = illuminant == Illuminant::d65 ? lerp(cie::illuminant_d65[i], cie::illuminant_d65[i + 1]) : 1.0;
    return {{lerp(a[0], b[0]), lerp(a[1], b[1]), lerp(a[2], b[2])}, light};
}

// The integrand is a cubic polynomial between two knots, which Simpson's rule integrates exactly.
template <class F>
Vec3 simpson(double from, double to, const F& f) {
    return (f(from) + 4.0 * f(0.5 * (from + to)) + f(to)) * ((to - from) / 6.0);
}

}  // namespace

glm::dmat3 rgb_from_xyz() {
    return glm::transpose(glm::dmat3(3.240479, -1.537150, -0.498535, -0.969256, 1.875991, 0.041556, 0.055648, -0.204043, 1.057311));
}

Rgb radiance_to_rgb(const Vec3& xyz) {
    static const glm::dmat3 scaled = [] {
        double y = 0.0;  // the trapezoidal rule; ȳ at both ends is below 1e-5
        for (const auto& curves : cie::observer_1931) y += curves[1] * cie::step;
        return rgb_from_xyz() / y;
    }();
    return scaled * xyz;
}

Rgb spectrum_to_rgb(const SpectrumTable& s, Illuminant illuminant) {
    std::vector<double> knots = s.wavelengths;
    for (int i = 0; i < cie::count; ++i) knots.push_back(cie::first_wavelength + i * cie::step);
    std::sort(knots.begin(), knots.end());

    Vec3 xyz(0.0);
    double norm = 0.0;
    for (std::size_t i = 1; i < knots.size(); ++i) {
        const double from = std::max(knots[i - 1], cie::first_wavelength), to = std::min(knots[i], cie::last_wavelength);
        if (from >= to) continue;
        norm += simpson(from, to, [&](double w) {
                    const Weights at = weights_at(w, illuminant);
                    return Vec3(at.light * at.xyz.y);
                }).y;
        if (from < s.wavelengths.front() || to > s.wavelengths.back()) continue;
        xyz += simpson(from, to, [&](double w) {
            const Weights at = weights_at(w, illuminant);
            return at.xyz * (at.light * value_at(s, w));
        });
    }
    return rgb_from_xyz() * (xyz / norm);
}

double srgb_decode(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

}  // namespace neumann
