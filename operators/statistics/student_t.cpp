#include "operators/statistics/student_t.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace neumann {

double student_t_quantile(double confidence, double degrees_of_freedom) {
    if (!(degrees_of_freedom >= 1.0)) return std::numeric_limits<double>::infinity();
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.5 + 0.5 * confidence);
}

double student_t_two_sided(double t, double degrees_of_freedom) {
    if (!(degrees_of_freedom >= 1.0) || std::isnan(t)) return std::numeric_limits<double>::quiet_NaN();
    if (std::isinf(t)) return 0.0;
    return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(degrees_of_freedom), std::abs(t)));
}

}  // namespace neumann
