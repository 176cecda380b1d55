// Norms and leading eigenpairs of one channel of K, from its applications alone.
//
// ‖K‖∞ and ‖K‖₁ bound the spectral radius; the series converges exactly where the spectral radius is below 1, whatever the norms
// are. Radiosity with edges and corners is not compact: apart from the leading one, eigenvalues of the matrix belong to the mesh.
#pragma once

#include "operators/solvers/channel_operator.h"

#include <complex>
#include <vector>

namespace neumann {

// In the norms Σ m|f|, (Σ m f²)^½ and max |f|, m the measure.
struct OperatorNorms {
    double one = 0.0, two = 0.0, sup = 0.0;
};

// For K ≥ 0: row sums of K and of K*, and the largest singular value by Lanczos on K*K.
OperatorNorms operator_norms(const ChannelOperator& K);

struct Eigenpair {
    std::complex<double> value;
    Eigen::VectorXcd vector;  // ‖v‖₂ = 1, unweighted
    double residual = 0.0;    // ‖K v − λ v‖₂
};

struct Eigenpairs {
    std::vector<Eigenpair> pairs;  // by falling |λ|; conjugate pairs are two
    bool converged = false;        // all that were asked for
    double applications = 0.0;     // n where K was small and formed
};

// The `count` eigenvalues of largest modulus, by Arnoldi's method with implicit restarts (Spectra), or of the matrix where it has
// at most 64 unknowns. Of the adjoint K* where asked for. The start is fixed, so that the answer is too. An eigenvalue with
// several vectors may come with fewer of them, as from every method that builds on one start.
Eigenpairs leading_eigenpairs(const ChannelOperator& K, int count, bool adjoint = false);

// |λ₁|, or not a number where it was not found.
double spectral_radius(const ChannelOperator& K);

}  // namespace neumann
