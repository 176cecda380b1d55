#include "core/material/beckmann.h"

#include <boost/math/special_functions/erf.hpp>

#include <algorithm>

namespace neumann {

namespace {

// Samples a slope with the density exp(−x²)/√π, whose cumulative distribution is (1 + erf x)/2.
double gaussian_slope(double u) {
    using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    constexpr double largest = 1.0 - 0x1p-53;
    return boost::math::erf_inv(std::clamp(2.0 * u - 1.0, -largest, largest), Policy());
}

// Samples the slope visible from (sinθ, 0, cosθ), with density ∝ (cosθ − x sinθ)⁺ exp(−x²). Its cumulative distribution is inverted
// by bracketed Newton iteration.
double visible_slope(double sine, double cosine, double u) {
    if (sine < 1e-9) return gaussian_slope(u);
    const auto distribution = [&](double x) {
        return 0.5 * cosine * (1.0 + std::erf(x)) + 0.28209479177387814347 * sine * std::exp(-x * x);
    };
    double low = -6.0, high = std::min(cosine / sine, 6.0);
    const double wanted = u * distribution(high);
    double x = std::clamp(gaussian_slope(u), low, high);
    for (int i = 0; i < 100; ++i) {
        const double excess = distribution(x) - wanted;
        (excess > 0.0 ? high : low) = x;
        double next = x - excess / ((cosine - x * sine) * std::exp(-x * x) * 2.0 * 0.28209479177387814347);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - x) < 1e-13) break;
        x = next;
    }
    return x;
}

}  // namespace

Vec3 Beckmann::sample_visible(const Vec3& v, const Vec2& u) const {
    const Vec3 w = glm::normalize(Vec3(alpha_.x * v.x, alpha_.y * v.y, v.z));
    const double sine = std::sqrt(w.x * w.x + w.y * w.y);
    const Vec2 towards = sine > 0.0 ? Vec2(w.x, w.y) / sine : Vec2(1.0, 0.0);
    const double along = visible_slope(sine, w.z, u.x), across = gaussian_slope(u.y);
    const Vec2 slope = alpha_ * (along * towards + across * Vec2(-towards.y, towards.x));
    return glm::normalize(Vec3(-slope, 1.0));
}

}  // namespace neumann
