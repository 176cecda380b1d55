#include "core/material/diffuse_fresnel.h"

#include "core/material/fresnel.h"

#include <boost/math/quadrature/gauss.hpp>

namespace neumann {

double diffuse_fresnel(double n) {
    if (n < 1.0) return 1.0 - n * n * (1.0 - diffuse_fresnel(1.0 / n));
    // Substitutes μ = s², because F is steep at grazing angles.
    const auto integrand = [n](double s) { return conductor_fresnel(s * s, n, 0.0) * 4.0 * s * s * s; };
    double sum = 0.0;
    for (const auto& [from, to] : {std::pair{0.0, 0.125}, {0.125, 0.25}, {0.25, 0.5}, {0.5, 1.0}})
        sum += boost::math::quadrature::gauss<double, 30>::integrate(integrand, from, to);
    return sum;
}

double fitted_diffuse_fresnel(double n) {
    if (n < 1.0) return ((-1.4399 * n + 0.7099) * n + 0.6681) + 0.0636 / n;
    const double x = 1.0 / n;
    return ((((-1.36881 * x + 4.98554) * x - 7.80989) * x + 6.75335) * x - 3.4793) * x + 0.919317;
}

}  // namespace neumann
