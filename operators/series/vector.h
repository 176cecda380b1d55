// Fields with one value per unknown, and their norms.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace neumann {

using Vector = Eigen::VectorXd;  // one value per unknown

// Other fields with one value per unknown have this overload too, and can be constructed from a Vector.
inline const Vector& to_vector(const Vector& x) { return x; }

// L1, L2 and L∞ of a vector: power Σ m|t| (W, where t is radiance and m area times projected solid angle), (Σ m t²)^½ and max |t|.
struct TermNorms {
    double power = 0.0, l2 = 0.0, sup = 0.0;
};

inline TermNorms norms(const Vector& t, const Vector& measure) {
    if (t.size() == 0) return {};
    return {measure.dot(t.cwiseAbs()), std::sqrt(measure.dot(t.cwiseAbs2())), t.lpNorm<Eigen::Infinity>()};
}

}  // namespace neumann
