// Fields with one value per unknown, and their norms.
#pragma once

#include <Eigen/Core>

namespace neumann {

using Vector = Eigen::VectorXd;  // one value per unknown

// Other fields with one value per unknown have this overload too, and can be constructed from a Vector.
inline const Vector& to_vector(const Vector& x) { return x; }

// L1, L2 and L∞ of a vector: power Σ m|t| (W, where t is radiance and m area times projected solid angle), (Σ m t²)^½ and max |t|.
struct TermNorms {
    double power = 0.0, l2 = 0.0, sup = 0.0;
};

}  // namespace neumann
