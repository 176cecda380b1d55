// Spaces that K maps into themselves, whose eigenvalues are eigenvalues of K.
//
// The vectors x, K x, K² x … span a space that closes after as many steps as K's minimal polynomial has degrees: after two for the
// integrating sphere, after m where light ends after m bounces. A method that goes on from there divides by rounding errors.
#pragma once

#include "operators/solvers/spectrum/scaled_product.h"

#include <optional>
#include <vector>

namespace neumann {

// K V = V H, with orthonormal columns of V.
struct ClosedSpace {
    Eigen::MatrixXd V, H;
};

// A space has closed if the part of K x outside it, relative to the size of K, is below this: then it is nothing but
// rounding errors.
constexpr double closing = 1e-14;

// Adds spaces that fixed pseudo-random vectors span (Arnoldi's method) until there are `wanted` columns and the last one has
// closed.
void extend(ClosedSpace& space, const ScaledProduct& K, Eigen::Index wanted);

// The `wanted` pairs V y, H y = λ y, of largest modulus, or as many as there are. Their residuals are left at 0.
std::vector<Eigenpair> leading_pairs(const Eigen::MatrixXd& V, const Eigen::MatrixXd& H, Eigen::Index wanted);

// Returns a v ≠ 0 with K v = 0 exactly if K^m = 0, that is if light ends whatever emits. All eigenvalues are 0 then; a
// method that computes them would find the m-th root of ε. For K ≥ 0 this follows the unknowns that have light, of
// which each bounce leaves fewer, until there are none or they stay the same. Scales K by its first product.
std::optional<Vector> last_light(ScaledProduct& K);

}  // namespace neumann
