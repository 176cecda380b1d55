#include "operators/fields/matrix/channel_choice.h"

#include "operators/fields/matrix/scene_patches.h"
#include "operators/solvers/spectrum/convergence.h"
#include "operators/solvers/spectrum/radius_bounds.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <cmath>

namespace neumann {

namespace {

struct Radius {
    double value = 0.0, applications = 0.0;
    std::string why;  // why it was not found
};

Radius find_radius(const MatrixSystem& system, int c, const Watch& watch) {
    const std::unique_ptr<ChannelOperator> K = system.reflected(c);
    double applications = 0.0;
    // Light trapped in glass by total reflection has many eigenvectors with eigenvalue 1, so that searches do not converge.
    if (has_glass(system.space())) {
        const RadiusBounds bounds = radius_bounds(*K, most_for_bounds, watch);
        applications += bounds.applications;
        if (bounds.meet()) return {bounds.high, applications, ""};
    }
    EigenLimits limits;
    limits.watch = watch;
    const Eigenpairs leading = system.leading(*K, 1, limits);
    return {leading.radius(), applications + leading.applications, leading.why};
}

}  // namespace

ChosenChannel choose_channel(const MatrixSystem& system, std::optional<int> given, const Watch& watch) {
    ChosenChannel chosen;
    const int channels = system.channels();
    if (channels == 1) given.reset();
    double applications = 0.0;
    for (int c = 0; c < channels; ++c) {
        if (given && *given != c) continue;
        const Radius radius = find_radius(system, c, watch);
        applications += radius.applications;
        const bool larger = radius.value > chosen.radius || (std::isnan(chosen.radius) && !std::isnan(radius.value));
        if (given || c == 0 || larger) chosen = {c, radius.value, radius.why, false, 0.0, ""};
    }
    chosen.applications = applications;
    chosen.traps_light = has_glass(system.space()) && judge(chosen.radius, 0.0) == Convergence::at_one;
    chosen.why = channels == 1 ? "the scene is grey" : given ? "as asked for" : "it has the largest spectral radius";
    return chosen;
}

int most_reflecting_channel(const TracedSystem& system) {
    int best = 0;
    double most = -1.0;
    for (int c = 0; c < system.channels(); ++c) {
        const TracedChannel K = system.channel(c);
        Vector left(K.size());
        K.apply(Vector::Ones(K.size()), left);
        if (const double power = K.measure().dot(left); power > most) {
            most = power;
            best = c;
        }
    }
    return best;
}

}  // namespace neumann
