// Intervals for means of few observations.
#pragma once

namespace neumann {

// t with P(|T| ≤ t) = confidence for Student's distribution; infinite where degrees_of_freedom < 1.
double student_t_quantile(double confidence, double degrees_of_freedom);

// P(|T| > t); normal where there are infinitely many degrees of freedom. NaN where degrees_of_freedom < 1.
double student_t_two_sided(double t, double degrees_of_freedom);

}  // namespace neumann
