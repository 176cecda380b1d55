#include "operators/series/enclosure.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

Enclosure enclose(const Vector& term, const Vector& later, const Vector& sum, const Vector& rest) {
    Enclosure result;
    double c1 = std::numeric_limits<double>::infinity(), c2 = 0.0;
    for (Eigen::Index u = 0; u < term.size(); ++u) {
        const double t = term[u], next = later[u];
        if (!(t >= 0.0 && next >= 0.0)) {
            result.why = fmt::format("a term is negative or not a number at unknown {}", u);
            return result;
        }
        if (t == 0.0 && next == 0.0) continue;
        if (t == 0.0) {
            result.why = fmt::format("the term before is 0 at unknown {}, and this one is not", u);
            return result;
        }
        c1 = std::min(c1, next / t);
        c2 = std::max(c2, next / t);
    }
    result.c1 = std::min(c1, c2);
    result.c2 = c2;
    if (!(c2 < 1.0)) {
        result.why = fmt::format("the largest quotient of terms is {:.6g}, not below 1", c2);
        return result;
    }
    result.exists = true;
    result.low = sum + result.c1 / (1.0 - result.c1) * rest;
    result.high = sum + c2 / (1.0 - c2) * rest;
    const double size = result.high.size() == 0 ? 0.0 : result.high.maxCoeff();
    result.width = size > 0.0 ? (result.high - result.low).maxCoeff() / size : 0.0;
    return result;
}

}  // namespace neumann
