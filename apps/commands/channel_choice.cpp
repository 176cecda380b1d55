#include "apps/commands/channel_choice.h"

#include "apps/commands/interrupt.h"
#include "core/base/error.h"
#include "operators/matrix/scene_patches.h"
#include "operators/spectrum/convergence.h"
#include "operators/spectrum/radius_bounds.h"
#include "operators/spectrum/spectrum.h"

#include <cmath>

namespace neumann {

namespace {

// Until K ≥ 0 is known to keep some light for good.
constexpr double most_for_bounds = 1000.0;

struct Radius {
    double value = 0.0, applications = 0.0;
    std::string why;  // why it was not found
};

Radius find_radius(const PatchScene& scene, int c) {
    const TracedChannel K = scene.system().channel(c);
    double applications = 0.0;
    // Light trapped in glass by total reflection has many eigenvectors with eigenvalue 1, so that searches do not converge.
    if (has_glass(scene.system().space())) {
        const RadiusBounds bounds = radius_bounds(K, most_for_bounds, {.stop = interrupted});
        applications += bounds.applications;
        if (bounds.meet()) return {bounds.high, applications, ""};
    }
    EigenLimits limits;
    limits.watch.stop = interrupted;
    const Eigenpairs leading = leading_eigenpairs(K, 1, false, limits);
    return {leading.radius(), applications + leading.applications, leading.why};
}

}  // namespace

void check_channel_name(const std::string& name) {
    if (!name.empty() && name != "r" && name != "g" && name != "b") throw InputError("--channel " + name + ": expected r, g or b");
}

ChosenChannel choose_channel(const PatchScene& scene, const std::string& wanted) {
    check_channel_name(wanted);
    ChosenChannel chosen;
    const int channels = scene.system().channels();
    const bool given = !wanted.empty() && channels > 1;
    double applications = 0.0;
    for (int c = 0; c < channels; ++c) {
        if (given && wanted != scene.channel_letter(c)) continue;
        const Radius radius = find_radius(scene, c);
        applications += radius.applications;
        const bool larger = radius.value > chosen.radius || (std::isnan(chosen.radius) && !std::isnan(radius.value));
        if (given || c == 0 || larger) chosen = {c, radius.value, radius.why, false, 0.0, ""};
    }
    chosen.applications = applications;
    chosen.traps_light = has_glass(scene.system().space()) && judge(chosen.radius, 0.0) == Convergence::at_one;
    chosen.why = channels == 1 ? "the scene is grey" : given ? "as asked for" : "it has the largest spectral radius";
    return chosen;
}

}  // namespace neumann
