// The convergence rate of a method: the slope of log RMSE against log work, by weighted least squares.
//
// Every point has y = ½ log MSE, and by propagation σ_y = σ_MSE / (2 MSE); the scatter of the work enters as slope · σ_x (York,
// Least-squares fitting of a straight line, 1966). With w = 1/σ² the slope is Σ c_i y_i, c_i = w_i (x_i − x̄) / Σ w (x − x̄)², its
// variance Σ c² σ². An error δ that all MSE share, such as that of the reference, moves the slope by δ Σ c_i / (2 MSE_i); this is
// added to the error. If the points scatter about the line by more than their errors, the error is multiplied by √(χ²/(n − 2)), as
// the Particle Data Group does (Birge, The Calculation of Errors by the Method of Least Squares, 1932).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace neumann {

struct ErrorPoint {
    double work = 0.0, work_error = 0.0;  // seconds or samples, and their standard error
    double mse = 0.0, mse_error = 0.0;    // MSE and its standard error over repeats
};

struct ErrorSlope {
    double slope = 0.0, standard_error = 0.0;
    double half_width = 0.0;  // of the 95% interval
    std::size_t points = 0;   // number of points used
};

// Whether log MSE is meaningful: the MSE is larger than two standard errors, with all given errors included.
bool is_resolved(const ErrorPoint& point, double shared_error);

// The slope of the points that are resolved and whose error is known. Nothing if there are fewer than two, or if all have the same
// work.
std::optional<ErrorSlope> error_slope(std::span<const ErrorPoint> points, double shared_error = 0.0);

// The work at which the RMSE reaches `rmse`, by log-log interpolation between neighbouring points. below: the first point is
// already better, and `work` is its work. Nothing if no point is as good.
struct WorkToError {
    double work = 0.0;
    bool below = false;
};
// `points` must be in the order of their work.
std::optional<WorkToError> work_to_error(std::span<const ErrorPoint> points, double rmse);

}  // namespace neumann
