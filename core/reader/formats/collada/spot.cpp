#include "core/reader/formats/collada/spot.h"

#include <cmath>

namespace neumann::reader::collada {

Mat4 facing_back(const Mat4& node) {
    const auto unit = [&](int column) {
        const Vec3 v(node[column]);
        const double length = length_of(v);
        return glm::dvec4(length > 0.0 ? v / length : v, 0.0);
    };
    return {-unit(0), unit(1), -unit(2), glm::dvec4(Vec3(node[3]), 1.0)};
}

double spot_beam_width(double cutoff, double exponent) {
    if (exponent == 0.0) return cutoff;
    // Powers are divided by 2π and by the intensity on the axis.
    const double c = glm::radians(cutoff);
    const double wanted = (1.0 - std::pow(std::cos(c), exponent + 1.0)) / (exponent + 1.0);
    const auto power = [&](double beam) { return 1.0 - (std::sin(c) - std::sin(beam)) / (c - beam); };
    double low = 0.0, high = c;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (middle < c && power(middle) < wanted ? low : high) = middle;
    }
    return std::fmin(glm::degrees(low), cutoff);
}

}  // namespace neumann::reader::collada
