#include "operators/algebra/enclosure.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

Enclosure enclose(const Vector& term, const Vector& later, const Vector& sum, const Vector& rest, const Agreement& agreement) {
    Enclosure result;
    enum { none, vanished, negative } trouble = none;
    double c1 = std::numeric_limits<double>::infinity(), c2 = 0.0;
    for (Eigen::Index u = 0; u < term.size() && trouble == none; ++u) {
        const double t = term[u], next = later[u];
        if (!(t >= 0.0 && next >= 0.0)) {
            result.why = fmt::format("a term is negative or not a number at unknown {}", u);
            trouble = negative;
        } else if (t > 0.0) {
            c1 = std::min(c1, next / t);
            c2 = std::max(c2, next / t);
        } else if (next > 0.0) {
            result.why = fmt::format("the term before is 0 at unknown {}, and this one is not", u);
            trouble = vanished;
        }
    }
    double all[] = {-c1, c2, static_cast<double>(trouble)};
    agreement.largest(all);
    c1 = -all[0];
    c2 = all[1];
    if (all[2] > 0.0) {
        if (trouble == none) result.why = "a term is negative, or 0 before one that is not, in the part of another process";
        return result;
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
    const double size = agreement.size(result.high);
    result.width = size > 0.0 ? agreement.size(result.high - result.low) / size : 0.0;
    return result;
}

}  // namespace neumann
