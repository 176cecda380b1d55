// One channel of pictures under separate lights, unbounced: terms, their errors, and how far they can be trusted.
#pragma once

#include "operators/experiments/unbounce/cancellation.h"
#include "operators/experiments/unbounce/transport_inverse.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

// Values of regions (rows) under lights (columns), and the variances of their errors, empty where these are not known.
struct ChannelPictures {
    Eigen::MatrixXd T, T_variance;
    Eigen::MatrixXd direct, direct_variance;    // empty: T¹ is told by T⁻¹
    Eigen::VectorXd picture, picture_variance;  // the picture to unbounce; empty: that of all lights together
    // Of independent parts, whose means T and the direct light are, where errors go together. Empty: errors are independent.
    struct Part {
        Eigen::MatrixXd T;
        Eigen::VectorXd direct;
    };
    std::vector<Part> parts = {};

    bool knows_errors() const { return T_variance.size() > 0; }
};

// Values and standard errors, of one shape; errors are 0 where they are not known.
struct WithErrors {
    Eigen::MatrixXd value, error;
};

struct UnbouncedChannel {
    std::vector<int> lights;  // of all those given, the ones that are in the matrices: a light whose region is black cannot be told
    Conditioning conditioning;
    double regularisation = 0.0;  // α
    double series_radius = 0.0;   // of Bai's series of T⁻¹
    Cancellation operators;
    Eigen::MatrixXd weights;                // T⁻¹ Cⁿ⁻¹ L, a column a term
    WithErrors terms, once_more, given_on;  // Cⁿ L, a column a term; A; the sums of A's rows
    Eigen::VectorXd mean_errors;            // of each term's mean over pixels
};

// `shares`: the part of the picture that each region covers. `regularisation`: α; by default 0, or by the discrepancy principle if
// a singular matrix lies within the errors. Standard errors are those of 64 repeats with other errors of the pictures, normal, and
// independent or as they go together in the parts, drawn by `seed`.
UnbouncedChannel unbounce_channel(const ChannelPictures& pictures, const Eigen::VectorXd& shares, int bounces,
                                  std::optional<double> regularisation, std::uint64_t seed);

constexpr int unbounce_repeats = 64;
// Of the errors; `parts`: their number, or 0.
double unbounce_degrees_of_freedom(std::size_t parts);

}  // namespace neumann
