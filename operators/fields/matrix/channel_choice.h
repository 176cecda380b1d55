// Chooses a colour channel for work on a single one.
#pragma once

#include "operators/fields/matrix/traced_system.h"

#include <optional>
#include <string>

namespace neumann {

struct ChosenChannel {
    int channel = 0;
    double radius = 0.0;        // spectral radius of its K; not a number if it was not found
    std::string no_radius;      // why it was not found
    bool traps_light = false;   // glass traps light: the radius is 1, and tells nothing of light outside of the glass
    double applications = 0.0;  // applications of K to find the radius, in all channels tried
    std::string why;
};

// The given channel, or else the one with the largest spectral radius. A grey scene has only one channel.
ChosenChannel choose_channel(const MatrixSystem& system, std::optional<int> given, const Watch& watch = {});

// The channel whose K leaves most of uniform light, found without a search: the one with the largest Rayleigh quotient
// ⟨K 1, 1⟩ / ⟨1, 1⟩.
int most_reflecting_channel(const TracedSystem& system);

}  // namespace neumann
