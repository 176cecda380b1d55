// The series converges if and only if the spectral radius is below 1. Norms only bound the radius.
#pragma once

#include <cmath>

namespace neumann {

enum class Convergence {
    converges,
    undecided,  // the radius differs from 1 by less than its uncertainty, or is not known
    at_one,     // 1 to rounding: albedo 1 in a closed room
    diverges
};

// `uncertainty` is that of a radius computed from rays and patches. If it is not a number, it is unknown and counts as 0.
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
