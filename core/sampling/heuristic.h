// Multiple importance sampling: Veach 1997, 9.2.
#pragma once

namespace neumann {

enum class Heuristic { power, balance };

// The weight of a sample with density `a` that another technique finds with density `b`: a² / (a² + b²).
inline double power_heuristic(double a, double b) {
    const double ratio = b / a;
    return 1.0 / (1.0 + ratio * ratio);
}

// The power heuristic, or the balance heuristic a / (a + b).
inline double heuristic(Heuristic kind, double a, double b) {
    return kind == Heuristic::power ? power_heuristic(a, b) : 1.0 / (1.0 + b / a);
}

}  // namespace neumann
