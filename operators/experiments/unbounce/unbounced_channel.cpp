#include "operators/experiments/unbounce/unbounced_channel.h"

#include "core/sampling/counter_based.h"
#include "core/sampling/warp.h"
#include "operators/experiments/unbounce/inverse_series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A region is black if its light under its own light is below this part of the largest such value.
constexpr double black = 1e-9;

// Rows and columns of the chosen lights.
ChannelPictures chosen(const ChannelPictures& all, const std::vector<int>& lights) {
    const auto submatrix = [&](const MatrixXd& matrix) -> MatrixXd {
        return matrix.size() == 0 ? MatrixXd() : MatrixXd(matrix(lights, lights));
    };
    const auto part = [&](const VectorXd& vector) -> VectorXd {
        return vector.size() == 0 ? VectorXd() : VectorXd(vector(lights));
    };
    ChannelPictures some{submatrix(all.T),  submatrix(all.T_variance), submatrix(all.direct), submatrix(all.direct_variance),
                         part(all.picture), part(all.picture_variance)};
    for (const auto& [T, direct] : all.parts) some.parts.push_back({submatrix(T), part(direct)});
    return some;
}

class Deviates {
public:
    Deviates(std::uint64_t seed, std::uint32_t repeat) : numbers_(seed, repeat) {}

    // Returns `values` with other errors.
    MatrixXd operator()(const MatrixXd& values, const MatrixXd& variance) {
        MatrixXd result = values;
        for (Eigen::Index i = 0; i < variance.size(); ++i) result.data()[i] += std::sqrt(variance.data()[i]) * next();
        return result;
    }

    // Adds errors with the covariance of the parts' means to T and the direct light: Σ_p ξ_p (T_p − T) / √(P (P − 1)), normal ξ.
    void disturb(ChannelPictures& pictures) {
        const auto P = static_cast<double>(pictures.parts.size());
        const MatrixXd T = pictures.T, direct = pictures.direct;
        for (const auto& part : pictures.parts) {
            const double x = next() / std::sqrt(P * (P - 1.0));
            pictures.T += x * (part.T - T);
            if (direct.size() > 0) pictures.direct.diagonal() += x * (part.direct - direct.diagonal());
        }
    }

private:
    // The next deviate, by G. E. P. Box and M. E. Muller (1958).
    double next() {
        const auto [a, b, c, d] = numbers_(index_++, 0);
        const auto uniform = [](std::uint32_t high, std::uint32_t low) {
            return (static_cast<double>(std::uint64_t{high} << 32 | low) + 0.5) * 0x1p-64;
        };
        return std::sqrt(-2.0 * std::log(uniform(a, b))) * std::cos(2.0 * pi * uniform(c, d));
    }

    CounterBased numbers_;
    std::uint64_t index_ = 0;
};

struct Solution {
    Cancellation operators;
    UnbouncedRegions regions;
    MatrixXd once_more;
    VectorXd given_on;

    MatrixXd terms() const {
        MatrixXd result(operators.T.rows(), static_cast<Eigen::Index>(regions.terms.size()));
        for (std::size_t n = 0; n < regions.terms.size(); ++n) result.col(static_cast<Eigen::Index>(n)) = regions.terms[n];
        return result;
    }
};

Solution solution(const ChannelPictures& pictures, double alpha, int bounces) {
    Solution result;
    result.operators.T = pictures.T;
    result.operators.inverse = TransportInverse(pictures.T).at(alpha);
    result.operators.direct = pictures.direct.size() > 0 ? pictures.direct : direct_light(pictures.T, result.operators.inverse);
    result.regions =
        unbounce(result.operators, pictures.picture.size() > 0 ? pictures.picture : pictures.T.rowwise().sum(), bounces);
    result.once_more = result.operators.once_more();
    result.given_on = result.once_more.rowwise().sum();
    return result;
}

class Spread {
public:
    void add(const MatrixXd& x) {
        if (count_++ == 0) mean_ = squares_ = MatrixXd::Zero(x.rows(), x.cols());
        const MatrixXd change = x - mean_;
        mean_ += change / count_;
        squares_ += change.cwiseProduct(x - mean_);
    }
    MatrixXd deviation() const { return (squares_ / (count_ - 1)).cwiseSqrt(); }

private:
    int count_ = 0;
    MatrixXd mean_, squares_;
};

void add_errors(const ChannelPictures& pictures, const VectorXd& shares, int bounces, std::uint64_t seed,
                UnbouncedChannel& result) {
    Spread terms, once_more, given_on, means;
    for (int repeat = 0; repeat < unbounce_repeats; ++repeat) {
        Deviates other(seed, static_cast<std::uint32_t>(repeat));
        ChannelPictures noisy = pictures;
        if (pictures.parts.empty()) {
            noisy.T = other(pictures.T, pictures.T_variance);
            noisy.direct = other(pictures.direct, pictures.direct_variance);
        } else {
            other.disturb(noisy);
        }
        noisy.picture = other(pictures.picture, pictures.picture_variance);
        const Solution found = solution(noisy, result.regularisation, bounces);
        terms.add(found.terms());
        once_more.add(found.once_more);
        given_on.add(found.given_on);
        means.add(shares.transpose() * found.terms());
    }
    result.terms.error = terms.deviation();
    result.once_more.error = once_more.deviation();
    result.given_on.error = given_on.deviation();
    result.mean_errors = means.deviation().transpose();
}

double chosen_regularisation(const ChannelPictures& pictures, const TransportInverse& inverse, const Conditioning& conditioning) {
    if (!conditioning.is_singular()) return 0.0;
    const VectorXd sum = pictures.T.rowwise().sum();
    const double rounding = std::numeric_limits<double>::epsilon() * sum.norm();
    return inverse.by_discrepancy(sum, pictures.knows_errors() ? std::sqrt(pictures.T_variance.sum()) : rounding);
}

}  // namespace

// Combines the degrees of freedom of a covariance from P parts with those of 64 repeats.
double unbounce_degrees_of_freedom(std::size_t parts) {
    const double repeats = unbounce_repeats - 1.0;
    return parts == 0 ? repeats : 1.0 / (1.0 / repeats + 1.0 / (static_cast<double>(parts) - 1.0));
}

UnbouncedChannel unbounce_channel(const ChannelPictures& all, const VectorXd& all_shares, int bounces,
                                  std::optional<double> regularisation, std::uint64_t seed) {
    UnbouncedChannel result;
    for (int j = 0; j < all.T.cols(); ++j)
        if (all_shares[j] > 0.0 && all.T(j, j) > 0.0 && all.T(j, j) > black * all.T.col(j).maxCoeff()) result.lights.push_back(j);
    const auto size = static_cast<Eigen::Index>(result.lights.size());
    if (size == 0) return result;

    const ChannelPictures pictures = chosen(all, result.lights);
    const VectorXd shares = all_shares(result.lights);
    const TransportInverse inverse(pictures.T);
    result.conditioning = inverse.conditioning(pictures.T_variance);
    result.regularisation = regularisation ? *regularisation : chosen_regularisation(pictures, inverse, result.conditioning);
    result.series_radius = inverse_series_radius(pictures.T);

    Solution found = solution(pictures, result.regularisation, bounces);
    const auto exact = [](const MatrixXd& value) { return WithErrors{value, MatrixXd::Zero(value.rows(), value.cols())}; };
    result.terms = exact(found.terms());
    result.once_more = exact(found.once_more);
    result.given_on = exact(found.given_on);
    result.mean_errors = VectorXd::Zero(bounces);
    result.weights.resize(size, bounces);
    for (int n = 0; n < bounces; ++n) result.weights.col(n) = found.regions.weights[static_cast<std::size_t>(n)];
    result.operators = std::move(found.operators);
    if (pictures.knows_errors()) add_errors(pictures, shares, bounces, seed, result);
    return result;
}

}  // namespace neumann
