#include "operators/statistics/student_t.h"

#include <boost/math/distributions/students_t.hpp>
#include <limits>

namespace neumann {

double student_t_quantile(double confidence, double degrees_of_freedom) {
    if (!(degrees_of_freedom >= 1.0)) return std::numeric_limits<double>::infinity();
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.5 + 0.5 * confidence);
}

}  // namespace neumann
