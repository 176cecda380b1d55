// What the spectral radius says of the series: it converges exactly where that is below 1. Norms only bound it.
#pragma once

#include <cmath>

namespace neumann {

enum class Convergence {
    converges,
    undecided,  // the radius is as near to 1 as it is uncertain, or is not known
    at_one,     // 1 to rounding: albedo 1 in a closed room
    diverges
};

// `uncertainty`: of a radius that rays and patches give; not a number where it is not known, which is taken as 0.
inline Convergence judge(double radius, double uncertainty) {
    constexpr double rounding = 1e-10;
    if (!std::isfinite(radius)) return Convergence::undecided;
    if (std::abs(radius - 1.0) <= rounding) return Convergence::at_one;
    if (std::abs(radius - 1.0) <= uncertainty) return Convergence::undecided;
    return radius < 1.0 ? Convergence::converges : Convergence::diverges;
}

inline const char* name(Convergence convergence) {
    switch (convergence) {
        case Convergence::converges:
            return "converges";
        case Convergence::undecided:
            return "undecided";
        case Convergence::at_one:
            return "does not converge";
        case Convergence::diverges:
            return "diverges";
    }
    return "";
}

}  // namespace neumann
