// What can be asked of the walk; its code is in walk.h.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/sampling/heuristic.h"
#include "operators/walk/ending.h"
#include "operators/walk/left_out.h"

namespace neumann {

// How the light of the last reflection is found.
enum class DirectLight {
    hemisphere,  // directions, uniform
    cosine,      // directions by their cosine
    bsdf,        // directions of the material, which are those in which the walk goes on
    surfaces,    // points on all surfaces, uniform by area
    light,       // points on lights
    mis          // light and bsdf, weighted by a heuristic (Veach 1997, 9.2)
};

struct DirectLightSettings {
    DirectLight direct = DirectLight::mis;
    LightChoice lights = LightChoice::mixed;
    LightPlace place = LightPlace::area;
    Heuristic heuristic = Heuristic::power;

    bool operator==(const DirectLightSettings&) const = default;
};

// What is done at the first vertex of each camera ray, where one sample does the most: light is asked for `lights` times, and
// `walks` go on from it, both averaged. After that walks are single. One of each makes paths, several make trees (Arvo and Kirk
// 1990).
struct Split {
    int lights = 1, walks = 1;

    bool operator==(const Split&) const = default;
};

struct WalkSettings {
    int bounces = 8;  // N: the last term with a picture of its own
    DirectLightSettings direct = {};
    Roulette roulette = {};
    Split split = {};
    LeftOut left_out = {};
    // Probability with which a walk goes on beyond bounce N into the rest Σ_{k>N} K^k Le, at reciprocal weight; 0: no rest.
    double rest_probability = 1.0;
    // Bounces beyond N after which a walk is given up and counted.
    int give_up = 1'000'000;

    Ending ending() const { return {bounces, roulette, rest_probability, give_up}; }
};

}  // namespace neumann
