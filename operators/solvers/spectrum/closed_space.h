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

// What is left of K x beside a space, relative to the product's size, if it is nothing but rounding errors: the space has closed.
constexpr double closing = 1e-14;

// Adds spaces that fixed pseudo-random vectors span (Arnoldi's method) until there are `wanted` columns and the last one has
// closed.
void extend(ClosedSpace& space, const ScaledProduct& K, Eigen::Index wanted);

// The `wanted` pairs V y, H y = λ y, of largest modulus, or as many as there are; without their residuals.
std::vector<Eigenpair> leading_pairs(const Eigen::MatrixXd& V, const Eigen::MatrixXd& H, Eigen::Index wanted);

// Where light ends whatever emits, K^m = 0: a last v ≠ 0 with K v = 0 exactly. All eigenvalues are 0 then; a method that computes
// them finds the m-th root of ε. For K ≥ 0 this follows the unknowns that have light, of which each bounce leaves fewer, until they
// are none or stay the same. Scales K by its first product.
std::optional<Vector> last_light(ScaledProduct& K);

}  // namespace neumann
