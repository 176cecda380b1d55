// How an error falls with the work that is spent: the slope of log RMSE against log work, by weighted least squares.
//
// Every point has y = ½ log MSE, and by propagation σ_y = σ_MSE / (2 MSE); the scatter of the work enters as slope · σ_x (York,
// Least-squares fitting of a straight line, 1966). With w = 1/σ² the slope is Σ c_i y_i, c_i = w_i (x_i − x̄) / Σ w (x − x̄)², its
// variance Σ c² σ². An error that all MSE share, as that of a reference, moves the slope by δ Σ c_i / (2 MSE_i): it is added. Where
// the points scatter about the line by more than that, the error is widened by √(χ²/(n − 2)), as the Particle Data Group does
// (Birge, The Calculation of Errors by the Method of Least Squares, 1932).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace neumann {

struct ErrorPoint {
    double work = 0.0, work_error = 0.0;  // seconds or samples, and their standard error
    double mse = 0.0, mse_error = 0.0;    // and that over repeats
};

struct ErrorSlope {
    double slope = 0.0, standard_error = 0.0;
    double half_width = 0.0;  // of the 95% interval
    std::size_t points = 0;   // that were used
};

// Whether log MSE means anything there: the MSE is positive by two standard errors, of all that are given.
bool is_resolved(const ErrorPoint& point, double shared_error);

// From points that is_resolved() takes and whose error is known; none for fewer than two of them, or if all are of the same work.
std::optional<ErrorSlope> error_slope(std::span<const ErrorPoint> points, double shared_error = 0.0);

// The work at which the RMSE is `rmse`: on the straight lines between neighbouring points, log against log. below: the first point
// is better already, and `work` its work. None where no point is as good.
struct WorkToError {
    double work = 0.0;
    bool below = false;
};
// Points in the order of their work.
std::optional<WorkToError> work_to_error(std::span<const ErrorPoint> points, double rmse);

}  // namespace neumann
