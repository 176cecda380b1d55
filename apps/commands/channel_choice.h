// Chooses a colour channel for commands that work on a single one.
#pragma once

#include "apps/commands/patch_scene.h"

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

// Throws InputError unless it is r, g, b, or empty.
void check_channel_name(const std::string& name);

// The channel `wanted`, or the one with the largest spectral radius if that is empty.
ChosenChannel choose_channel(const PatchScene& scene, const std::string& wanted);

}  // namespace neumann
