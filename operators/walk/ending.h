// How paths end, from the camera and from lights: by roulette on their way; beyond the last picture by that and by chance; and in
// the end they are given up. What goes on by chance has the reciprocal weight.
#pragma once

#include "operators/walk/path_end.h"
#include "operators/walk/roulette.h"
#include "operators/walk/together.h"

#include <cstdint>
#include <span>

namespace neumann {

struct Ending {
    int bounces;  // N: the last with a picture of its own; beyond it is the rest
    Roulette roulette;
    double rest_probability;  // of going on into the rest; 0: there is none
    int give_up;              // bounces of the rest

    bool in_rest(int bounce) const { return bounce > bounces; }
    bool is_last(int bounce) const { return bounce == bounces && rest_probability == 0.0; }

    // Whether there are any that reach this bounce, having reached the one before.
    template <class Walker, class Sampler>
    bool reach(int bounce, Together<Walker>& paths, std::span<Sampler> samplers, std::uint64_t& given_up) const {
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

    // Whether a path lives on after a reflection, whose weight was `reflected` in its largest channel. `whole`: the β that counts
    // as 1.
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
