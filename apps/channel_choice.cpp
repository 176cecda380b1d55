#include "apps/channel_choice.h"

#include "core/base/error.h"
#include "operators/matrix/scene_patches.h"
#include "operators/spectrum/convergence.h"
#include "operators/spectrum/spectrum.h"

#include <cmath>
#include <limits>

namespace neumann {

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
        const Eigenpairs leading = leading_eigenpairs(scene.system().channel(c), 1);
        applications += leading.applications;
        const double radius = leading.pairs.empty() ? std::numeric_limits<double>::quiet_NaN() : std::abs(leading.pairs[0].value);
        if (given || c == 0 || radius > chosen.radius) chosen = {c, radius, false, 0.0, ""};
    }
    chosen.applications = applications;
    chosen.traps_light = has_glass(scene.system().space()) && judge(chosen.radius, 0.0) == Convergence::at_one;
    chosen.why = channels == 1 ? "the scene is grey" : given ? "as asked for" : "it has the largest spectral radius";
    return chosen;
}

}  // namespace neumann
