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
    bool traps_light = false;   // glass traps light: the radius is 1, which says nothing about light outside of it
    double applications = 0.0;  // applications of K to find the radius, in all channels tried
    std::string why;
};

// The given channel, or else the one with the largest spectral radius. If the scene is grey, its only channel.
ChosenChannel choose_channel(const MatrixSystem& system, std::optional<int> given, const Watch& watch = {});

// The channel whose K leaves most of uniform light, without a search: of the largest ⟨K 1, 1⟩ / ⟨1, 1⟩, a Rayleigh quotient.
int most_reflecting_channel(const TracedSystem& system);

}  // namespace neumann
