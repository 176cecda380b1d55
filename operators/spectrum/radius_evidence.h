// What the spectral radius says where the terms of a series stopped getting smaller: they have no sum where it is 1 or more.
//
// The terms alone do not tell. Behind forty mirrors they stay as they are for forty bounces; where K is not normal they may grow
// for long before they fall; below 10⁻³⁰⁸ they are all rounding.
#pragma once

#include "operators/spectrum/convergence.h"
#include "operators/spectrum/spectrum.h"

#include <limits>
#include <optional>

namespace neumann {

class RadiusEvidence {
public:
    // K has to outlive it. `given`: its spectral radius, or an estimate of it.
    RadiusEvidence(const ChannelOperator* K, std::optional<double> given) : K_(K), radius_(given) {}

    // Finds the radius where it was not given, the first time; where it cannot be found, nothing is shown.
    bool shows_divergence() {
        find();
        return known_to_diverge();
    }
    // As far as it was given or found by now.
    bool known_to_diverge() const {
        const Convergence verdict = judge(radius(), 0.0);
        return verdict == Convergence::diverges || verdict == Convergence::at_one;
    }
    bool known_to_converge() const { return judge(radius(), 0.0) == Convergence::converges; }

    double radius() const { return radius_.value_or(std::numeric_limits<double>::quiet_NaN()); }
    double applications() const { return applications_; }  // of K, that finding it took

private:
    void find() {
        if (radius_) return;
        // A radius that takes more than these few hundred applications is that of a K far from normal, as behind many mirrors.
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
