#pragma once

namespace neumann {

// t with P(|T| ≤ t) = confidence for Student's distribution; infinite if degrees_of_freedom < 1.
double student_t_quantile(double confidence, double degrees_of_freedom);

// P(|T| > t); normal if degrees_of_freedom is infinite, NaN if it is below 1.
double student_t_two_sided(double t, double degrees_of_freedom);

}  // namespace neumann
