// The settings of walk() (walk.h).
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/sampling/heuristic.h"
#include "operators/paths/walk/ending.h"
#include "operators/paths/walk/left_out.h"

namespace neumann {

// The sampling strategy for direct light at the last reflection.
enum class DirectLight {
    hemisphere,  // directions, uniform by solid angle
    cosine,      // directions, with density proportional to the cosine
    bsdf,        // directions of the BSDF, in which the walk also goes on
    surfaces,    // points on all surfaces, uniform by area
    light,       // points on lights
    mis          // light and bsdf, weighted by a heuristic (Veach 1997, 9.2)
};

struct DirectLightSettings {
    DirectLight direct = DirectLight::mis;
    LightChoice lights = LightChoice::mixed;
    LightPlace place = LightPlace::area;
    Heuristic heuristic = Heuristic::power;
    std::shared_ptr<const LightVisibility> visibility = nullptr;  // of LightChoice::seen (seen_lights.h)

    bool operator==(const DirectLightSettings&) const = default;
};

// Splitting at the first vertex of each camera ray, where more samples help most: `lights` light samples are taken, and `walks`
// walks go on from it; both are averaged. There is no splitting after that (Arvo and Kirk 1990).
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
    // The probability with which a walk goes on beyond bounce N into the rest Σ_{k>N} K^k Le (its weight is divided by
    // it); 0: no rest.
    double rest_probability = 1.0;
    // The number of bounces beyond N after which a walk is given up and counted.
    int give_up = 1'000'000;

    Ending ending() const { return {bounces, roulette, rest_probability, give_up}; }
};

}  // namespace neumann
