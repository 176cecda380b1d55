// Vectors with one value per unknown, and their norms.
#pragma once

#include <Eigen/Core>

namespace neumann {

using Vector = Eigen::VectorXd;

// Other types of fields with one value per unknown have an overload of this function too, and can be constructed from a Vector.
inline const Vector& to_vector(const Vector& x) { return x; }

// The norms of a vector t: the power Σ m|t| (W, where t is radiance and m area times projected solid angle), the L2
// norm (Σ m t²)^½, and the sup norm max |t|.
struct TermNorms {
    double power = 0.0, l2 = 0.0, sup = 0.0;
};

}  // namespace neumann
