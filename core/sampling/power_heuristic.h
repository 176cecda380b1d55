// Multiple importance sampling: Veach 1997, 9.2.4.
#pragma once

namespace neumann {

// The weight of a sample with density `a`, where another technique finds it with density `b`: a² / (a² + b²).
inline double power_heuristic(double a, double b) {
    const double ratio = b / a;
    return 1.0 / (1.0 + ratio * ratio);
}

}  // namespace neumann
