// The mistakes that path tracers make: each is a function of what stands at a vertex of a path. A new one is a name here and an
// entry in the list.
#pragma once

#include "core/base/vec.h"
#include "operators/paths/walk/walk_settings.h"

#include <span>

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
    inverse_distance,   // 1/d for 1/d², likewise
    no_area,            // samples of lamps are not multiplied by the lamp's area, or divided by it
    over_area,
    half_light,  // light samples count half or twice, and directions that hit lamps as they should
    twice_light,
    no_shadows,
    lamps_shine_back,
    light_twice,           // light samples and directions that hit lamps both count in full
    emission_at_bounce_1,  // likewise at bounce 1 alone
    // There are no light samples, and directions that hit lamps count with their weights (paths with s = 1 are missing).
    no_lamp_samples,
    no_samples_at_the_end,  // the last vertex that a limit of depth allows has no light samples
    no_hits,                // directions that hit lamps do not count, and light samples count with their weights (s = 0 is missing)
    no_light_after_mirror,
    no_caustics,     // no light that reaches other surfaces by mirrors or glass
    no_mirrors,      // mirrors and glass reflect nothing
    black_backs,     // sides whose normal points away are black
    no_emission,     // lamps are not seen directly
    next_no_cosine,  // in the weight of the direction in which the walk goes on from a surface
    next_cosine_squared,
    cosine_as_uniform,  // directions by the cosine with the uniform density, and the other way round
    uniform_as_cosine,
    even_theta,  // θ is uniform in [0, π/2]
    half_hemisphere,
    next_half,
    next_over_pi,
    next_times_pi,
    next_albedo_squared,
    next_white,
    no_roulette_weight,  // survivors of Russian roulette do not weigh more
    roulette_one_minus,  // they are divided by 1 - p
    roulette_squared,    // by p²
    clamped              // the contribution of a path is at most a limit
};

// A sample of a lamp: cosθ at the receiver and at the lamp, the distance squared, and the lamp's area; a lamp at infinity has the
// last three 1.
struct LampSight {
    double cosine, lamp_cosine, distance2, area;
};
// A reflection at a surface that is no mirror.
struct Reflection {
    Rgb albedo;
    bool is_behind;  // on a side whose normal points away, of a surface that lets no light through
};
// The next direction w of a walk, not from a mirror; the normal is the z-axis of w, and n that of the world.
struct NextDirection {
    Vec3 w, w_in_world, n;
    Rgb albedo;
};
// The probability p with which Russian roulette lets a walk go on is the walk's throughput, or the reflectance of the surface that
// it has met (before the lamp samples there) or of the one that it leaves (after them).
enum class Survival { by_throughput, by_reflectance, by_reflectance_before };

// The factor by which a mistake multiplies what a path brings; null functions are 1.
struct MistakeKind {
    Mistake mistake;
    const char *name, *words;
    std::span<const DirectLight> direct_light;  // those in which it shows differently
    double (*lamp_sample)(const LampSight&) = nullptr;
    Rgb (*reflection)(const Reflection&) = nullptr;
    Rgb (*next_direction)(const NextDirection&) = nullptr;
    double (*survivors)(double p) = nullptr;  // p times the weight of survivors
    Survival survival = Survival::by_throughput;
};

// The first is `none`. Kinds of one mistake differ in what pictures cannot know, such as the p of Russian roulette.
std::span<const MistakeKind> mistake_kinds();

}  // namespace neumann
