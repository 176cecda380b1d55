#include "core/material/rough_transmittance.h"

#include "core/material/beckmann.h"
#include "core/material/fresnel.h"
#include "core/material/ggx.h"

#include <boost/math/quadrature/gauss.hpp>

namespace neumann {

namespace {

// Integrates a function over the facets visible from a direction of cosine μ.
template <class Microfacets, class Function>
double mean_over_facets(const Microfacets& facets, double mu, const Function& f) {
    using Rule = boost::math::quadrature::gauss<double, 30>;
    const Vec3 wo(std::sqrt(1.0 - mu * mu), 0.0, mu);
    return Rule::integrate(
        [&](double x) {
            return Rule::integrate([&](double y) { return f(wo, facets.sample_visible(wo, {x, y})); }, 0.0, 1.0);
        },
        0.0, 1.0);
}

template <class Microfacets>
double masking(const Microfacets& facets, const Vec3& w) {
    return w.z > 0.0 ? w.z / facets.projected_area(w) : 0.0;
}

template <class Microfacets>
double reflected(const Microfacets& facets, double mu, double eta) {
    return mean_over_facets(facets, mu, [&](const Vec3& wo, const Vec3& m) {
        const double cosine = glm::dot(wo, m);
        return conductor_fresnel(cosine, eta, 0.0) * masking(facets, 2.0 * cosine * m - wo);
    });
}

template <class Microfacets>
double transmitted(const Microfacets& facets, double mu, double eta) {
    return mean_over_facets(facets, mu, [&](const Vec3& wo, const Vec3& m) {
        const double cosine = glm::dot(wo, m), cos2 = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
        if (cos2 <= 0.0) return 0.0;
        const Vec3 inside = wo / eta + (std::sqrt(cos2) - cosine / eta) * m;  // the refracted direction, seen from the other side
        return (1.0 - conductor_fresnel(cosine, eta, 0.0)) * masking(facets, inside);
    });
}

}  // namespace

template <class Microfacets>
RoughTransmittance::RoughTransmittance(const Microfacets& facets, double eta) {
    for (int i = 0; i < nodes; ++i) {
        const double mu = std::max(static_cast<double>(i) / (nodes - 1), 1e-6);
        T_[static_cast<std::size_t>(i)] = transmitted(facets, mu, eta);
        internal_reflectance_ += reflected(facets, mu, 1.0 / eta) * mu * 2.0 / nodes;
    }
}
template RoughTransmittance::RoughTransmittance(const Ggx&, double);
template RoughTransmittance::RoughTransmittance(const Beckmann&, double);

// The sum over intervals of ∫₀¹ (a + (b − a) t) 2 (i + t) h² dt.
double RoughTransmittance::mean() const {
    constexpr double h = 1.0 / (nodes - 1);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < nodes; ++i) {
        const double a = T_[i], slope = T_[i + 1] - T_[i], from = static_cast<double>(i);
        sum += 2.0 * h * h * (a * (from + 0.5) + slope * (0.5 * from + 1.0 / 3.0));
    }
    return sum;
}

}  // namespace neumann
