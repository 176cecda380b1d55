// The summary of one method and one picture in a study: the errors at every budget, their convergence rate and their cost.
#pragma once

#include "operators/experiments/study/error_slope.h"
#include "operators/experiments/study/picture_errors.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

// The times of the repeats of one budget: seconds before the first sample, and in total.
struct RepeatCosts {
    std::vector<double> setup_seconds, seconds;
};

// Times are summarised by medians, because other work on the machine makes some of them longer.
WithError median_with_error(std::vector<double> values);

// The RMSE of an MSE, by propagation; 0 for one that is negative because of the reference's noise.
WithError rmse_of(const WithError& mse);

struct PointSummary {
    double samples = 0.0;
    WithError setup_seconds, sampling_seconds, seconds;  // medians; `seconds` is both together
    WithError mse, rmse, rel_mse;                        // errors of mse and rmse include those of repeats and of the reference
    bool resolved = false;                               // the MSE is larger than the noise in it
    WithError variance, bias_squared;
    double bias_half_width = 0.0;  // of the 95% interval of bias², Student's t; in truth it covers 93.5% to 98.5%
    bool biased = false;           // 0 is outside of the 99.9% interval, which is wide because many are tested
    double efficiency = 0.0;       // 1 / (V T)
    double merit = 0.0;            // 1 / (MSE T), bias included; with MSE plus two standard errors if it is not resolved
    bool infinite_variance = false;

    // The RMSE, or if it is not resolved, a bound on it.
    double largest_rmse() const { return std::sqrt(1.0 / (merit * seconds.value)); }
};

struct PictureSummary {
    std::vector<PointSummary> points;
    std::optional<ErrorSlope> slope;             // of RMSE against seconds
    std::optional<ErrorSlope> slope_by_samples;  // of RMSE against samples per pixel
    std::optional<WorkToError> seconds_to_error;
    bool infinite_variance = false;
    int rank = 0;
};

struct StudiedPoint {
    double samples = 0.0;
    const RepeatCosts& costs;
    const ErrorStatistics& errors;
    bool infinite_variance = false;
};

// `reference_size`: √⟨r̂²⟩. Biases below the rounding of floats count as 0.
PictureSummary summarise(std::span<const StudiedPoint> points, double reference_size);

// An RMSE that all methods reach: the largest of the RMSEs at each method's largest budget. Only methods of finite variance count,
// if there are any.
double error_reached_by_all(std::span<const PictureSummary> methods);
void find_seconds_to_error(PictureSummary& summary, double rmse, std::span<const StudiedPoint> points);

// Ranks the methods by merit at the largest budget, starting with 1; those of infinite variance come last.
void rank(std::span<PictureSummary*> methods);

}  // namespace neumann
