// The pictures that a path tracer makes with a mistake: the classic mistakes, all sampled along the same paths. A
// mistake multiplies the contribution of a path by a factor that depends on its vertices, so that one walk gives a
// sample of every wrong picture.
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/difference_test.h"
#include "operators/experiments/blame/other_pictures.h"
#include "operators/watch.h"

#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

enum class Mistake {
    none,
    times_pi,  // in each reflection other than by mirrors and glass
    over_pi,
    albedo_squared,
    white,      // reflectances are taken as 1
    no_cosine,  // at the receiver, for light samples
    cosine_squared,
    no_light_cosine,    // |cosθ| at the lamp, likewise
    no_inverse_square,  // 1/d², likewise
    half_light,         // light samples count half or twice, and directions that hit lamps as they should
    twice_light,
    no_shadows,
    lamps_shine_back,
    light_twice,  // light samples and directions that hit lamps both count in full
    // There are no light samples, and directions that hit lamps count with their weights (paths with s = 1 are missing).
    no_lamp_samples,
    no_hits,  // directions that hit lamps do not count, and light samples count with their weights (s = 0 is missing)
    no_light_after_mirror,
    no_caustics,         // no light that reaches other surfaces by mirrors or glass
    no_mirrors,          // mirrors and glass reflect nothing
    black_backs,         // sides whose normal points away are black
    no_emission,         // lamps are not seen directly
    no_roulette_weight,  // survivors of Russian roulette do not weigh more
    clamped              // the contribution of a path is at most a limit
};
// A mistake's name, such as "albedo_squared", and its description: "reflectances are multiplied in twice".
const char* name_of(Mistake mistake);
const char* describe(Mistake mistake);

struct WrongTerms {
    Mistake mistake;
    bool without_hits = false;        // direct light by light samples alone, not by multiple importance sampling
    double limit = 0.0;               // for `clamped`: the limit in units of the mean of the first range
    std::vector<PictureNoise> terms;  // for each of the ranges
};

// Samples the pictures of all mistakes. Roulette and limits begin with the first bounce of `ranges`. Throws Stopped.
std::vector<WrongTerms> wrong_terms(const Scene& scene, const std::vector<BounceRange>& ranges, int samples, std::uint64_t seed,
                                    const Watch& watch = {});

}  // namespace neumann
