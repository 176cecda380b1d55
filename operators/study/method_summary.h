// What a study says of one method and one picture: its errors at every budget, how they fall, and how much they cost.
#pragma once

#include "operators/study/error_slope.h"
#include "operators/study/picture_errors.h"

#include <optional>
#include <span>
#include <vector>

namespace neumann {

// What repeats of one budget took: each one's seconds before its first sample, and in all.
struct RepeatCosts {
    std::vector<double> setup_seconds, seconds;
};

// Of the times a median: what else the machine does makes some of them longer.
WithError median_with_error(std::vector<double> values);

struct PointSummary {
    double samples = 0.0;
    WithError setup_seconds, sampling_seconds, seconds;  // medians; `seconds` is both together
    WithError rmse, rel_mse;                             // with the error by repeats and by the reference
    bool resolved = false;                               // the MSE is more than the noise of what it is judged by
    WithError variance, bias_squared;
    double bias_half_width = 0.0;  // of the 95% interval of bias², Student's t; it holds the truth in 93.5% to 98.5%
    bool biased = false;           // 0 is outside of the 99.9% interval: there are many to look at
    double efficiency = 0.0;       // 1 / (V T)
    double merit = 0.0;            // 1 / (MSE T), bias included; MSE plus two standard errors where it is not resolved
    bool infinite_variance = false;
};

struct PictureSummary {
    std::vector<PointSummary> points;
    std::optional<ErrorSlope> slope;             // of RMSE against seconds
    std::optional<ErrorSlope> slope_by_samples;  // and against samples a pixel
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

// `reference_size`: √⟨r̂²⟩. Biases below the rounding of floats are not told from 0.
PictureSummary summarise(std::span<const StudiedPoint> points, double reference_size);

// The largest RMSE that any method has left at its largest budget, so that all of them reach it, among those of finite variance if
// there are any.
double error_reached_by_all(std::span<const PictureSummary> methods);
void find_seconds_to_error(PictureSummary& summary, double rmse, std::span<const StudiedPoint> points);

// By merit at the largest budget, from 1; those of infinite variance come last.
void rank(std::span<PictureSummary*> methods);

}  // namespace neumann
