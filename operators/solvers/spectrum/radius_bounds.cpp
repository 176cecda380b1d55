#include "operators/solvers/spectrum/radius_bounds.h"

#include <cmath>
#include <limits>

namespace neumann {

RadiusBounds radius_bounds(const ChannelOperator& K, double most, const Watch& watch) {
    constexpr double rounding = 1e-9;
    constexpr int first = 16;
    RadiusBounds bounds{0.0, std::numeric_limits<double>::infinity(), 0.0};
    Vector x = Vector::Ones(K.size()), next(K.size());
    double log_size = 0.0;  // log ‖K^n 1‖∞; x is K^n 1, scaled to the norm 1
    for (int n = 1, look = first; bounds.applications < most && !K.agreement().any(watch.stop()); ++n) {
        K.apply(x, next);
        ++bounds.applications;
        const double size = K.agreement().size(next);
        if (!(size > 0.0)) return {0.0, 0.0, bounds.applications};
        log_size += std::log(size);
        bounds.high = std::min(bounds.high, std::exp(log_size / n));
        x = next / size;
        if (n < look) continue;
        look *= 2;
        const Vector largest = (x.array() >= 1.0 - rounding).cast<double>();
        K.apply(largest, next);
        ++bounds.applications;
        const double kept =
            K.agreement().lowest((largest.array() > 0.0).select(next.array(), std::numeric_limits<double>::infinity()).matrix());
        bounds.low = std::max(bounds.low, kept);
        if (bounds.meet()) break;
    }
    return bounds;
}

}  // namespace neumann
