#include "operators/render/methods/path_bias.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neumann {

void report_bias(const Film& film, const SeriesMoments::Result& result, const PathMethod& method, BounceSeries& series) {
    const std::optional<TwoRadii> radii = method.two_radii();
    if (!radii || !result.has_differences()) return;
    const auto report = [&](const Estimate& picture, double noise) {
        const double all = relative_discretisation(picture);
        return report_discretisation(film, picture,
                                     {relative_standard_error(picture), std::sqrt(std::max(all * all - noise * noise, 0.0))});
    };
    const auto size = [](const Image& image) {
        double squares = 0.0;
        for (const Rgb& x : image.pixels) squares += glm::dot(x, x);
        return std::sqrt(squares);
    };
    const double part = radii->part_of_bias;
    double noise = 0.0;
    for (std::size_t i = 0; i < series.report.bounces.size(); ++i) {
        const Estimate term = series.term(i);
        const double mean = size(term.mean);
        series.report.bounces[i].discretisation = report(term, mean > 0.0 ? result.noise_of_difference(i) / (part * mean) : 0.0);
        noise = std::hypot(noise, result.noise_of_difference(i));
    }
    const Estimate sum = series.sum(series.report.bounces.size() - 1);
    const double mean = size(sum.mean);
    series.report.sum_discretisation =
        report(sum, radii->difference_is_of_kernel ? relative_standard_error(sum) / (std::numbers::sqrt2 * part)
                    : mean > 0.0                   ? noise / (part * mean)
                                                   : 0.0);
}

}  // namespace neumann
