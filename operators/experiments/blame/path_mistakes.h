// What a path tracer makes of a scene when it makes a mistake: the classic ones, all sampled along the same paths. A mistake
// multiplies what a path brings by a factor that depends on its vertices, so that one walk gives a sample of every wrong picture.
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
    times_pi,  // in each reflection that is no mirror's or glass's
    over_pi,
    albedo_squared,
    white,      // reflectances are taken as 1
    no_cosine,  // at the receiver, where lamps are sampled
    cosine_squared,
    no_light_cosine,    // |cosθ| at the lamp, likewise
    no_inverse_square,  // 1/d², likewise
    half_light,         // samples of lamps count half or twice, and directions that find them as they should
    twice_light,
    no_shadows,
    lamps_shine_back,
    light_twice,      // samples of lamps and directions that hit them both count in full
    no_lamp_samples,  // lamps are not sampled, and directions that hit them count with their weights (paths with s = 1 are missing)
    no_hits,          // directions that hit lamps do not count, and samples of lamps count with their weights (s = 0 is missing)
    no_light_after_mirror,
    no_caustics,         // no light that comes by mirrors or glass to other surfaces
    no_mirrors,          // mirrors and glass reflect nothing
    black_backs,         // of sides whose normal points away
    no_emission,         // lamps are not seen directly
    no_roulette_weight,  // survivors of Russian roulette do not weigh more
    clamped              // what a path brings is at most a limit
};
// "albedo_squared", and in words: "reflectances are multiplied in twice".
const char* name_of(Mistake mistake);
const char* describe(Mistake mistake);

struct WrongTerms {
    Mistake mistake;
    bool without_hits = false;        // lamps are sampled and not also hit by chance; where not, by multiple importance sampling
    double limit = 0.0;               // of `clamped`, in units of the mean of the first range
    std::vector<PictureNoise> terms;  // for each of the ranges
};

// Samples what every mistake makes of these bounces. Roulette and limits begin with the first of them. Throws Stopped.
std::vector<WrongTerms> wrong_terms(const Scene& scene, const std::vector<BounceRange>& ranges, int samples, std::uint64_t seed,
                                    const Watch& watch = {});

}  // namespace neumann
