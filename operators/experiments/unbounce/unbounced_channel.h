// Unbounces one channel of pictures under separate lights: terms, their errors, and how far they can be trusted.
#pragma once

#include "operators/experiments/unbounce/cancellation.h"
#include "operators/experiments/unbounce/transport_inverse.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

// Values of regions (rows) under lights (columns), and the variances of their errors, which are empty if not known.
struct ChannelPictures {
    Eigen::MatrixXd T, T_variance;
    Eigen::MatrixXd direct, direct_variance;    // empty: T¹ follows from T⁻¹
    Eigen::VectorXd picture, picture_variance;  // the picture to unbounce; empty: that of all lights together
    // Independent parts with means T and the direct light, if errors are correlated. Empty: errors are independent.
    struct Part {
        Eigen::MatrixXd T;
        Eigen::VectorXd direct;
    };
    std::vector<Part> parts = {};

    bool knows_errors() const { return T_variance.size() > 0; }
};

// Values and standard errors, of one shape; errors are 0 if they are not known.
struct WithErrors {
    Eigen::MatrixXd value, error;
};

struct UnbouncedChannel {
    std::vector<int> lights;  // the given lights that are in the matrices: those whose region is black are left out
    Conditioning conditioning;
    double regularisation = 0.0;  // α
    double series_radius = 0.0;   // spectral radius of Bai's series of T⁻¹
    Cancellation operators;
    Eigen::MatrixXd weights;                // T⁻¹ Cⁿ⁻¹ L, a column for each term
    WithErrors terms, once_more, given_on;  // Cⁿ L, a column for each term; A; the sums of A's rows
    Eigen::VectorXd mean_errors;            // for the mean of each term over pixels
};

// `shares`: the part of the picture that each region covers. `regularisation`: α; by default 0, or by the discrepancy
// principle if a singular matrix lies within the errors. Standard errors are from 64 repeats with other errors of the
// pictures, which are normal, independent or correlated as in the parts, and drawn by `seed`.
UnbouncedChannel unbounce_channel(const ChannelPictures& pictures, const Eigen::VectorXd& shares, int bounces,
                                  std::optional<double> regularisation, std::uint64_t seed);

constexpr int unbounce_repeats = 64;
// The degrees of freedom of the errors; `parts`: their number, or 0.
double unbounce_degrees_of_freedom(std::size_t parts);

}  // namespace neumann
