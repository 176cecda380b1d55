#include "core/emitter/sky_model.h"

#include "core/emitter/sky_tables.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <cmath>

namespace neumann {

namespace {

// The value at x of the Bézier curve with the control points p(0) … p(5).
template <class Points>
double quintic(double x, const Points& p) {
    constexpr double binomials[] = {1, 5, 10, 10, 5, 1};
    double sum = 0.0;
    for (int i = 0; i < sky::elevations; ++i) sum += binomials[i] * std::pow(x, i) * std::pow(1.0 - x, 5 - i) * p(i);
    return sum;
}

// The processor's rounding is not changed, so bounds hold up to that.
using Interval =
    boost::numeric::interval<double,
                             boost::numeric::interval_lib::policies<boost::numeric::interval_lib::rounded_transc_exact<double>,
                                                                    boost::numeric::interval_lib::checking_base<double>>>;

Interval cosine(const Interval& angle) { return {std::cos(angle.upper()), std::cos(angle.lower())}; }  // within [0, π]

}  // namespace

SkyModel::SkyModel(double turbidity, const Rgb& albedo, double elevation) : elevation_(elevation) {
    const int below = std::min(static_cast<int>(turbidity), sky::turbidities - 1);  // the tables begin at 1
    const double x = std::cbrt(elevation / (0.5 * pi));
    const auto interpolate = [&](double a, const auto& table) {  // table(albedo, turbidity, control point)
        double sum = 0.0;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                const double weight = (i == 0 ? 1.0 - a : a) * (j == 0 ? below + 1 - turbidity : turbidity - below);
                sum += weight * quintic(x, [&](int point) { return table(i, below - 1 + j, point); });
            }
        return sum;
    };
    for (int i = 0; i < (is_grey(albedo) ? 1 : 3); ++i) {
        Channels& channels = of_albedo_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            double k[sky::coefficients];
            for (int n = 0; n < sky::coefficients; ++n)
                k[n] = interpolate(albedo[i], [&](int a, int t, int point) { return sky::distribution[c][a][t][point][n]; });
            const double M = interpolate(albedo[i], [&](int a, int t, int point) { return sky::mean_radiance[c][a][t][point]; });
            channels[c] = {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7], k[8], M};
        }
    }
}

template <class Number>
Number SkyModel::radiance(const Coefficients& k, const Number& cos_theta, const Number& gamma, const Number& cos_gamma) {
    using std::exp, std::sqrt;
    const Number square = cos_gamma * cos_gamma, distance = 1.0 + k.H * k.H - 2.0 * k.H * cos_gamma,
                 chi = (1.0 + square) / (distance * sqrt(distance));
    return k.M * (1.0 + k.A * exp(k.B / (cos_theta + 0.01))) *
           (k.C + k.D * exp(k.E * gamma) + k.F * square + k.G * chi + k.I * sqrt(cos_theta));
}

Rgb SkyModel::radiance(double cos_theta, double cos_gamma) const {
    const double gamma = std::acos(std::clamp(cos_gamma, -1.0, 1.0));
    const auto rgb = [&](const Channels& channels) {
        Vec3 xyz;
        for (int c = 0; c < 3; ++c) xyz[c] = radiance(channels[static_cast<std::size_t>(c)], cos_theta, gamma, cos_gamma);
        return radiance_to_rgb(xyz);
    };
    Rgb result = rgb(of_albedo_[0]);
    for (std::size_t c = 1; c < of_albedo_.size(); ++c) result[static_cast<int>(c)] = rgb(of_albedo_[c])[static_cast<int>(c)];
    return glm::max(result, Rgb(0.0));
}

Rgb SkyModel::largest() const {
    constexpr double degree = pi / 180.0;
    const double zenith_to_sun = 0.5 * pi - elevation_;
    Rgb most(0.0);
    for (int i = 0; i < 90; ++i)
        for (int j = 0; j < 180; ++j) {
            const Interval theta(i * degree, (i + 1) * degree), gamma(j * degree, (j + 1) * degree);
            // |θ − θ of the sun| ≤ γ ≤ θ + θ of the sun
            if (gamma.lower() > theta.upper() + zenith_to_sun || theta.lower() > gamma.upper() + zenith_to_sun ||
                zenith_to_sun > theta.upper() + gamma.upper())
                continue;
            const Interval cos_theta = max(cosine(theta), Interval(0.0)), cos_gamma = cosine(gamma);
            for (int c = 0; c < 3; ++c) {
                const Channels& channels = of_albedo_[std::min(static_cast<std::size_t>(c), of_albedo_.size() - 1)];
                Interval sum(0.0);
                for (int n = 0; n < 3; ++n)
                    sum += radiance_to_rgb(Vec3(n == 0, n == 1, n == 2))[c] *
                           radiance(channels[static_cast<std::size_t>(n)], cos_theta, gamma, cos_gamma);
                most[c] = std::max(most[c], sum.upper());
            }
        }
    return most;
}

}  // namespace neumann
