// Tells whether a series whose terms have stopped falling diverges: it does if the spectral radius is 1 or more.
//
// The terms alone cannot show it. Behind forty mirrors they stay constant for forty bounces; if K is not normal, they may grow for
// a long time before they fall; below 10⁻³⁰⁸ they consist of rounding errors.
#pragma once

#include "operators/solvers/spectrum/convergence.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <limits>
#include <optional>

namespace neumann {

class RadiusEvidence {
public:
    // K must outlive this object. `given` is the spectral radius of K, or an estimate of it.
    RadiusEvidence(const ChannelOperator* K, std::optional<double> given) : K_(K), radius_(given) {}

    // The first call computes the radius if it was not given. Returns false if the radius cannot be found.
    bool shows_divergence() {
        find();
        return known_to_diverge();
    }
    // These two functions do not compute the radius; they return false while it is unknown.
    bool known_to_diverge() const {
        const Convergence verdict = judge(radius(), 0.0);
        return verdict == Convergence::diverges || verdict == Convergence::at_one;
    }
    bool known_to_converge() const { return judge(radius(), 0.0) == Convergence::converges; }

    double radius() const { return radius_.value_or(std::numeric_limits<double>::quiet_NaN()); }
    double applications() const { return applications_; }  // of K, used to find the radius

private:
    void find() {
        if (radius_) return;
        // If more applications are needed, K is far from normal, as behind many mirrors.
        constexpr double few_hundred = 400.0;
        const Eigenpairs leading = leading_eigenpairs(*K_, 1, false, {.most = few_hundred});
        applications_ = leading.applications;
        radius_ = leading.radius();
    }

    const ChannelOperator* K_;
    std::optional<double> radius_;
    double applications_ = 0.0;
};

}  // namespace neumann
