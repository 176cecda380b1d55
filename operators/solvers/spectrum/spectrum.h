// Norms and leading eigenpairs of one channel of K, computed by applying K alone.
//
// ‖K‖∞ and ‖K‖₁ bound the spectral radius. The series converges if and only if the spectral radius is below 1, whatever the norms
// are. Radiosity with edges and corners is not compact: apart from the leading one, eigenvalues of the matrix belong to the mesh.
#pragma once

#include "operators/algebra/channel_operator.h"
#include "operators/watch.h"

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace neumann {

// The state of a search. `residual` is the largest ‖K v − λ v‖₂ / |λ| of the wanted pairs, with ‖v‖₂ = 1.
struct EigenStep {
    double applications = 0.0, residual = 1.0;
};

// The limits at which a search gives up.
struct EigenLimits {
    // The largest number of applications of K. A search also gives up when its residuals fall so slowly that it would need more.
    double most = 10000.0;
    std::function<void(const EigenStep&)> look = [](const EigenStep&) {};  // called before each application
    Watch watch = {};                                                      // a search that it stops has not converged
};

// The operator norms induced by Σ m|f|, (Σ m f²)^½ and max |f|, with the measure m. If f is radiance and m is étendue,
// Σ m|f| is power. `one_at` is the unknown whose power a bounce reduces least.
struct OperatorNorms {
    double one = 0.0, two = 0.0, sup = 0.0;  // two: not a number if it was not found
    Eigen::Index one_at = 0;
};

// Requires K ≥ 0. Takes row sums of K and of K*, and the largest singular value by Lanczos' method on K*K.
OperatorNorms operator_norms(const ChannelOperator& K, const EigenLimits& limits = {});

struct Eigenpair {
    std::complex<double> value;
    Eigen::VectorXcd vector;  // ‖v‖₂ = 1, unweighted
    double residual = 0.0;    // ‖K v − λ v‖₂
};

struct Eigenpairs {
    std::vector<Eigenpair> pairs;         // by falling |λ|; a conjugate pair is two of them. Approximations if not all were found
    bool converged = false;               // all that were wanted were found
    double applications = 0.0;            // the number of unknowns if K was small and its matrix was formed
    std::vector<EigenStep> history = {};  // one step for each restart
    std::string why =
        {};  // if they were not found, the reason: "not found within 512 applications of K, largest residual 2e-03: …"

    // |λ₁|; not a number if it was not found.
    double radius() const;
};

// The `count` eigenvalues of largest modulus of K, or of K* if `adjoint` is set, by Arnoldi's method with implicit restarts
// (Spectra). If K has at most 64 unknowns, its matrix is formed and decomposed. The start vector is fixed, so the result is
// reproducible. Like every method that starts from one vector, it may find fewer vectors of a multiple eigenvalue than there are.
Eigenpairs leading_eigenpairs(const ChannelOperator& K, int count, bool adjoint = false, const EigenLimits& limits = {});

// |λ₁|, or not a number if it was not found.
double spectral_radius(const ChannelOperator& K);

}  // namespace neumann
