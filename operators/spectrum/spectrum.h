// Norms and leading eigenpairs of one channel of K, from its applications alone.
//
// ‖K‖∞ and ‖K‖₁ bound the spectral radius; the series converges exactly where the spectral radius is below 1, whatever the norms
// are. Radiosity with edges and corners is not compact: apart from the leading one, eigenvalues of the matrix belong to the mesh.
#pragma once

#include "operators/solvers/channel_operator.h"
#include "operators/watch.h"

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace neumann {

// How far a search is: the largest ‖K v − λ v‖₂ / |λ| of the pairs that are wanted, ‖v‖₂ = 1.
struct EigenStep {
    double applications = 0.0, residual = 1.0;
};

// When a search ends that does not find what it looks for.
struct EigenLimits {
    double most = 10000.0;  // applications of K; also where it is foretold to take more
    std::function<void(const EigenStep&)> look = [](const EigenStep&) {};  // called before each
    Watch watch = {};                                                      // a search that it stops has found nothing
};

// In the norms Σ m|f|, (Σ m f²)^½ and max |f|, m the measure: where f is radiance and m étendue, the first is power. `one_at`: the
// unknown of which most of the power is left.
struct OperatorNorms {
    double one = 0.0, two = 0.0, sup = 0.0;  // two: not a number where it was not found
    Eigen::Index one_at = 0;
};

// For K ≥ 0: row sums of K and of K*, and the largest singular value by Lanczos on K*K.
OperatorNorms operator_norms(const ChannelOperator& K, const EigenLimits& limits = {});

struct Eigenpair {
    std::complex<double> value;
    Eigen::VectorXcd vector;  // ‖v‖₂ = 1, unweighted
    double residual = 0.0;    // ‖K v − λ v‖₂
};

struct Eigenpairs {
    std::vector<Eigenpair> pairs;         // by falling |λ|; conjugate pairs are two. What was reached, where not all were found
    bool converged = false;               // all that were asked for
    double applications = 0.0;            // n where K was small and formed
    std::vector<EigenStep> history = {};  // a step each restart
    std::string why = {};  // they were not found: "not found within 512 applications of K, largest residual 2e-03: …"

    // |λ₁|; not a number where it was not found.
    double radius() const;
};

// The `count` eigenvalues of largest modulus, by Arnoldi's method with implicit restarts (Spectra), or of the matrix where it has
// at most 64 unknowns. Of the adjoint K* where asked for. The start is fixed, so that the answer is too. An eigenvalue with
// several vectors may come with fewer of them, as from every method that builds on one start.
Eigenpairs leading_eigenpairs(const ChannelOperator& K, int count, bool adjoint = false, const EigenLimits& limits = {});

// |λ₁|, or not a number where it was not found.
double spectral_radius(const ChannelOperator& K);

}  // namespace neumann
