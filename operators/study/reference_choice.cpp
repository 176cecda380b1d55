#include "operators/study/reference_choice.h"

#include "operators/study/picture_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

std::vector<double> variance_times_rays(const BounceSeries& series) {
    std::vector<double> result;
    for (std::size_t i = 0; i < series.report.bounces.size(); ++i) {
        const PictureErrors errors(series.term(i));
        const double rounding = float_rounding * errors.reference_size();
        const bool unknown = series.report.bounces[i].infinite_variance || rounding == 0.0;
        result.push_back(unknown ? std::numeric_limits<double>::infinity()
                                 : std::max(errors.reference_mse(), rounding * rounding) * static_cast<double>(series.rays));
    }
    return result;
}

VarianceRatio variance_ratio(std::span<const double> first, std::span<const double> second) {
    std::vector<double> ratio;
    for (std::size_t i = 0; i < first.size(); ++i)
        ratio.push_back(std::isinf(first[i]) && std::isinf(second[i]) ? 1.0 : first[i] / second[i]);
    const auto [least, most] = std::minmax_element(ratio.begin(), ratio.end());
    return {*least, *most, static_cast<std::size_t>(least - ratio.begin()), static_cast<std::size_t>(most - ratio.begin())};
}

}  // namespace neumann
