// The Neumann series backwards: operators that keep the part of a picture that has bounced n times.
//
// T is a matrix of pictures of one channel, a column for each light, a row for each region of what is seen; T¹ holds
// the direct light in them. In a scene whose light is reflected diffusely, T = T¹ + A T, where A carries the light of
// all regions to all regions, so that T = (I − A)⁻¹ T¹, and with it
//
//     C¹ = T¹ T⁻¹ = I − A,    Cⁿ = Aⁿ⁻¹ C¹,    L = Σ Cⁿ L.
//
// S. M. Seitz, Y. Matsushita, K. N. Kutulakos, A Theory of Inverse Light Transport, ICCV 2005. Each light shines directly on one
// region, and no light goes from a region to itself; then T¹ is diagonal and follows from T⁻¹ = (T¹)⁻¹ (I − A): T¹_rr = 1/(T⁻¹)_rr.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace neumann {

// The matrices of one channel; region r is that of light r. If T⁻¹ is regularised, T T⁻¹ stands for I.
struct Cancellation {
    Eigen::MatrixXd T, inverse, direct;  // T (regions × lights), T⁻¹ (lights × regions), T¹ (regions × lights)

    Eigen::MatrixXd once_more() const { return (T - direct) * inverse; }
};

// T¹ from T⁻¹: T¹_rr = (T T⁻¹)_rr / (T⁻¹)_rr, which is 1/(T⁻¹)_rr without regularisation.
Eigen::MatrixXd direct_light(const Eigen::MatrixXd& T, const Eigen::MatrixXd& inverse);

// The terms of a picture L, which has one value for each region.
struct UnbouncedRegions {
    std::vector<Eigen::VectorXd> terms;  // Cⁿ L, n = 1 … N
    std::vector<Eigen::VectorXd>
        weights;  // T⁻¹ Cⁿ⁻¹ L, n = 1 … N, with C⁰ = I: lights that would light the regions as term n − 1 does
};

// Computes the first term as T¹ T⁻¹ L, and each further one as T − T¹ applied to T⁻¹ of the term before.
UnbouncedRegions unbounce(const Cancellation& operators, const Eigen::VectorXd& picture, int bounces);

}  // namespace neumann
