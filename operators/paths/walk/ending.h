// The ways in which paths from the camera and from lights end: by Russian roulette at every reflection; with
// probability 1 − rest_probability on the step from bounce N into the rest; and after give_up bounces of the rest they
// are given up. The weights of survivors are divided by the probability of surviving.
#pragma once

#include "operators/paths/walk/path_end.h"
#include "operators/paths/walk/roulette.h"
#include "operators/paths/walk/together.h"

#include <cstdint>
#include <span>

namespace neumann {

struct Ending {
    int bounces;  // N: the last bounce with a picture of its own; beyond it is the rest
    Roulette roulette;
    double rest_probability;  // probability of going on into the rest; 0: there is no rest
    int give_up;              // bounces in the rest after which a path is given up

    bool in_rest(int bounce) const { return bounce > bounces; }
    bool is_last(int bounce) const { return bounce == bounces && rest_probability == 0.0; }

    // Ends paths on the step from the previous bounce to this one. Returns whether any path goes on.
    template <class Walker, class Samplers>
    bool reach(int bounce, Together<Walker>& paths, Samplers&& samplers, std::uint64_t& given_up) const {
        if (in_rest(bounce)) {
            if (rest_probability == 0.0) return false;
            if (bounce - bounces > give_up) {
                given_up += paths.alive.size();
                return false;
            }
        }
        if (bounce == bounces + 1)
            paths.keep_if([&](PathEnd& end, std::uint32_t i) {
                if (rest_probability < 1.0 && samplers[i].next() >= rest_probability) return false;
                end.beta /= rest_probability;
                end.kept_weight = max_component(end.beta);
                return true;
            });
        return !paths.alive.empty();
    }

    // Russian roulette after a reflection: returns whether the path survives. `reflected` is the largest channel of the
    // reflection's weight, and `whole` the β that counts as 1.
    template <class Sampler>
    bool live(int bounce, PathEnd& end, double reflected, Sampler& sampler, double whole = 1.0) const {
        const bool rest = in_rest(bounce);
        if (!rest && roulette.kind == Roulette::Kind::none) return true;
        const double survival = roulette.probability(rest, reflected, max_component(end.beta) / whole, end.kept_weight / whole);
        if (survival < 1.0) {
            if (sampler.next() >= survival) return false;
            end.beta /= survival;
        }
        end.kept_weight = max_component(end.beta);
        return true;
    }
};

}  // namespace neumann
