// Matrices of pictures that are known to the last digit: T = (I − A)⁻¹ T¹.
#pragma once

#include "operators/experiments/unbounce/unbounced_channel.h"

#include <Eigen/LU>

#include <random>
#include <utility>
#include <vector>

namespace neumann::synthetic {

struct Room {
    Eigen::MatrixXd A, T;
    Eigen::VectorXd direct;  // the diagonal of T¹

    Room(Eigen::MatrixXd links, Eigen::VectorXd lit) : A(std::move(links)), direct(std::move(lit)) {
        T = (Eigen::MatrixXd::Identity(A.rows(), A.cols()) - A).partialPivLu().solve(Eigen::MatrixXd(direct.asDiagonal()));
    }

    // Aⁿ⁻¹ T¹ x.
    Eigen::VectorXd term(int n, const Eigen::VectorXd& x) const {
        Eigen::VectorXd result = direct.cwiseProduct(x);
        for (int i = 1; i < n; ++i) result = A * result;
        return result;
    }
    Eigen::VectorXd ones() const { return Eigen::VectorXd::Ones(direct.size()); }
    ChannelPictures pictures() const { return {T, {}, {}, {}, {}, {}}; }
};

// Regions that all see each other and give back this part of what arrives; lights of different strengths.
inline Room random_room(int regions, double reflectance, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(0.1, 1.0);
    Eigen::MatrixXd A(regions, regions);
    Eigen::VectorXd direct(regions);
    for (int i = 0; i < regions; ++i) {
        direct[i] = uniform(engine);
        for (int j = 0; j < regions; ++j) A(i, j) = i == j ? 0.0 : uniform(engine);
        A.row(i) *= reflectance / A.row(i).sum();
    }
    return {A, direct};
}

inline UnbouncedChannel unbounced(const ChannelPictures& pictures, int bounces, std::optional<double> regularisation = {},
                                  std::uint64_t seed = 0) {
    const auto regions = pictures.T.rows();
    return unbounce_channel(pictures, Eigen::VectorXd::Constant(regions, 1.0 / static_cast<double>(regions)), bounces,
                            regularisation, seed);
}

}  // namespace neumann::synthetic
