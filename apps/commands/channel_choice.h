// Which of a scene's channels a command looks at that can look at one only.
#pragma once

#include "apps/commands/patch_scene.h"

#include <string>

namespace neumann {

struct ChosenChannel {
    int channel = 0;
    double radius = 0.0;        // spectral radius of its K; not a number where it was not found
    std::string no_radius;      // why, then
    bool traps_light = false;   // within glass: the radius is 1, and says nothing of light that does not get there
    double applications = 0.0;  // to find the radius, of all channels looked at
    std::string why;
};

// Throws InputError unless it is r, g, b, or empty.
void check_channel_name(const std::string& name);

// The one asked for; otherwise the one with the largest spectral radius.
ChosenChannel choose_channel(const PatchScene& scene, const std::string& wanted);

}  // namespace neumann
