#include "operators/experiments/blame/mistake_kinds.h"

#include "core/sampling/warp.h"

#include <cmath>

namespace neumann {

namespace {

constexpr DirectLight both[] = {DirectLight::mis};
// Mistakes of light samples depend on how they share the work with directions that hit lamps.
constexpr DirectLight with_samples[] = {DirectLight::mis, DirectLight::light};
// Those of next directions spoil what is hit by them as well.
constexpr DirectLight any[] = {DirectLight::mis, DirectLight::light, DirectLight::bsdf};

Rgb inverse(const Rgb& albedo) {
    Rgb result(1.0);
    if (albedo == Rgb(0.0)) return result;
    for (int c = 0; c < 3; ++c) result[c] = albedo[c] > 0.0 ? 1.0 / albedo[c] : 0.0;
    return result;
}

double cosine(const Vec3& w) { return std::abs(w.z); }
double sine(const Vec3& w) { return std::sqrt(w.x * w.x + w.y * w.y); }

// Twice the side of a plane through the normal on which w lies, φ in [0, π]; `a`: where φ is 0.
Rgb half(const NextDirection& next, const Vec3& a) {
    return Rgb(glm::dot(next.w_in_world, glm::cross(next.n, a)) > 0.0 ? 2.0 : 0.0);
}

const MistakeKind kinds[] = {
    {Mistake::none, "none", "nothing is wrong", both},
    {Mistake::times_pi, "times_pi", "every diffuse reflection has a factor π too much (1/π is missing in the BRDF)", both, nullptr,
     [](const Reflection&) { return Rgb(pi); }},
    {Mistake::over_pi, "over_pi", "every diffuse reflection is divided by π once too often", both, nullptr,
     [](const Reflection&) { return Rgb(inv_pi); }},
    {Mistake::albedo_squared, "albedo_squared", "reflectances are multiplied in twice", both, nullptr,
     [](const Reflection& r) { return r.albedo; }},
    {Mistake::white, "white", "reflectances are left out: surfaces reflect as if they were white", both, nullptr,
     [](const Reflection& r) { return inverse(r.albedo); }},
    {Mistake::black_backs, "black_backs", "surfaces are black from behind: one-sided where they should be two-sided", both, nullptr,
     [](const Reflection& r) { return Rgb(r.is_behind ? 0.0 : 1.0); }},

    {Mistake::no_cosine, "no_cosine", "cosθ at the receiving surface is missing where lamps are sampled", with_samples,
     [](const LampSight& s) { return 1.0 / s.cosine; }},
    {Mistake::cosine_squared, "cosine_squared", "cosθ at the receiving surface counts twice where lamps are sampled", with_samples,
     [](const LampSight& s) { return s.cosine; }},
    {Mistake::no_light_cosine, "no_light_cosine", "cosθ at the lamp is missing where points on lamps are sampled", with_samples,
     [](const LampSight& s) { return 1.0 / s.lamp_cosine; }},
    {Mistake::no_inverse_square, "no_inverse_square", "1/d² is missing where points on lamps are sampled", with_samples,
     [](const LampSight& s) { return s.distance2; }},
    {Mistake::inverse_distance, "inverse_distance", "1/d stands in place of 1/d² where points on lamps are sampled", with_samples,
     [](const LampSight& s) { return std::sqrt(s.distance2); }},
    {Mistake::no_area, "no_area", "samples of lamps are not multiplied by the lamp's area A (divided by their density 1/A)",
     with_samples, [](const LampSight& s) { return 1.0 / s.area; }},
    {Mistake::over_area, "over_area",
     "samples of lamps are divided by the lamp's area A, not multiplied (the density is 1/A, not A)", with_samples,
     [](const LampSight& s) { return 1.0 / (s.area * s.area); }},
    {Mistake::half_light, "half_light", "samples of lamps count half (their area or their pdf is off by 2)", both,
     [](const LampSight&) { return 0.5; }},
    {Mistake::twice_light, "twice_light", "samples of lamps count twice (their area or their pdf is off by 2)", both,
     [](const LampSight&) { return 2.0; }},
    {Mistake::no_shadows, "no_shadows", "lamps shine through surfaces: visibility is not tested", with_samples},
    {Mistake::lamps_shine_back, "lamps_shine_back", "lamps shine from both sides", with_samples},
    {Mistake::light_twice, "light_twice",
     "light is counted twice: samples of lamps and directions that hit them both count in full", both},
    {Mistake::emission_at_bounce_1, "emission_at_bounce_1",
     "light of bounce 1 is counted twice: lamps that the first direction hits count beside samples of lamps", both},
    {Mistake::no_lamp_samples, "no_lamp_samples",
     "samples of lamps are missing (paths with s = 1), and directions that hit lamps have their weight beside them", both},
    {Mistake::no_samples_at_the_end, "no_samples_at_the_end",
     "the last vertex that the depth limit allows takes no samples of lamps, which first show in the picture of the next depth",
     with_samples},
    {Mistake::no_hits, "no_hits",
     "directions that hit lamps are missing (paths with s = 0), and samples of lamps have their weight beside them", both},
    {Mistake::no_light_after_mirror, "no_light_after_mirror",
     "lamps that are hit after a mirror or glass do not count: their reflections and caustics are missing", both},
    {Mistake::no_caustics, "no_caustics", "light that comes by way of mirrors or glass to other surfaces is missing", both},
    {Mistake::no_mirrors, "no_mirrors", "mirrors and glass reflect nothing", both},
    {Mistake::no_emission, "no_emission", "lamps are not seen directly", both},

    {Mistake::next_no_cosine, "next_no_cosine", "cosθ is missing in the weight of the next direction", any, nullptr, nullptr,
     [](const NextDirection& next) { return Rgb(1.0 / cosine(next.w)); }},
    {Mistake::next_cosine_squared, "next_cosine_squared",
     "cosθ counts twice in the weight of the next direction (sampled by the cosine, and multiplied by it)", any, nullptr, nullptr,
     [](const NextDirection& next) { return Rgb(cosine(next.w)); }},
    {Mistake::cosine_as_uniform, "cosine_as_uniform",
     "next directions are sampled by the cosine and divided by the uniform density 1/(2π)", any, nullptr, nullptr,
     [](const NextDirection& next) { return Rgb(2.0 * cosine(next.w)); }},
    {Mistake::uniform_as_cosine, "uniform_as_cosine", "next directions are sampled uniformly and divided by the density cosθ/π",
     any, nullptr, nullptr, [](const NextDirection& next) { return Rgb(0.5 / cosine(next.w)); }},
    // The density is 1/(π² sinθ).
    {Mistake::even_theta, "even_theta",
     "θ of the next direction is uniform in [0, π/2], which crowds directions around the normal, and their density is taken as "
     "1/(2π)",
     any, nullptr, nullptr, [](const NextDirection& next) { return Rgb(2.0 * inv_pi / sine(next.w)); }},
    {Mistake::even_theta, "even_theta",
     "θ of the next direction is uniform in [0, π/2], which crowds directions around the normal, and their density is taken as "
     "cosθ/π",
     any, nullptr, nullptr, [](const NextDirection& next) { return Rgb(inv_pi / (sine(next.w) * cosine(next.w))); }},
    // Where φ is 0 is told by the frame: those of smallpt, and of PBRT's first edition.
    {Mistake::half_hemisphere, "half_hemisphere", "next directions cover half of the hemisphere (φ in [0, π])", any, nullptr,
     nullptr,
     [](const NextDirection& next) {
         return half(next, glm::cross(std::abs(next.n.x) > 0.1 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), next.n));
     }},
    {Mistake::half_hemisphere, "half_hemisphere", "next directions cover half of the hemisphere (φ in [0, π])", any, nullptr,
     nullptr,
     [](const NextDirection& next) {
         const Vec3& n = next.n;
         return half(next, std::abs(n.x) > std::abs(n.y) ? Vec3(-n.z, 0, n.x) : Vec3(0, n.z, -n.y));
     }},
    {Mistake::next_half, "next_half",
     "next directions bring half of their light (they cover the whole sphere, and the density is 1/(2π))", any, nullptr, nullptr,
     [](const NextDirection&) { return Rgb(0.5); }},
    {Mistake::next_over_pi, "next_over_pi",
     "the weight of the next direction is divided by π once too often (albedo/π for directions by the cosine)", any, nullptr,
     nullptr, [](const NextDirection&) { return Rgb(inv_pi); }},
    {Mistake::next_times_pi, "next_times_pi", "the weight of the next direction has a factor π too much", any, nullptr, nullptr,
     [](const NextDirection&) { return Rgb(pi); }},
    {Mistake::next_albedo_squared, "next_albedo_squared",
     "reflectances are multiplied in twice in the weight of the next direction, and once where lamps are sampled", any, nullptr,
     nullptr, [](const NextDirection& next) { return next.albedo; }},
    {Mistake::next_white, "next_white", "the weight of the next direction lacks the reflectance", any, nullptr, nullptr,
     [](const NextDirection& next) { return inverse(next.albedo); }},

    {Mistake::no_roulette_weight, "no_roulette_weight", "survivors of Russian roulette are not divided by their probability", both,
     nullptr, nullptr, nullptr, [](double p) { return p; }},
    {Mistake::no_roulette_weight, "no_roulette_weight",
     "survivors of Russian roulette are not divided by their probability, which is the surface's reflectance", both, nullptr,
     nullptr, nullptr, [](double p) { return p; }, Survival::by_reflectance},
    {Mistake::no_roulette_weight, "no_roulette_weight",
     "survivors of Russian roulette are not divided by their probability, which is the reflectance of the surface before", both,
     nullptr, nullptr, nullptr, [](double p) { return p; }, Survival::by_reflectance_before},
    {Mistake::roulette_one_minus, "roulette_one_minus", "survivors of Russian roulette are divided by 1 - p, not by p", both,
     nullptr, nullptr, nullptr, [](double p) { return p / (1.0 - p); }},
    {Mistake::roulette_one_minus, "roulette_one_minus",
     "survivors of Russian roulette are divided by 1 - p, not by p, which is the surface's reflectance", both, nullptr, nullptr,
     nullptr, [](double p) { return p / (1.0 - p); }, Survival::by_reflectance},
    {Mistake::roulette_one_minus, "roulette_one_minus",
     "survivors of Russian roulette are divided by 1 - p, not by p, which is the reflectance of the surface before", both, nullptr,
     nullptr, nullptr, [](double p) { return p / (1.0 - p); }, Survival::by_reflectance_before},
    {Mistake::roulette_squared, "roulette_squared", "survivors of Russian roulette are divided by p twice", both, nullptr, nullptr,
     nullptr, [](double p) { return 1.0 / p; }},
    {Mistake::roulette_squared, "roulette_squared",
     "survivors of Russian roulette are divided by p twice, which is the surface's reflectance", both, nullptr, nullptr, nullptr,
     [](double p) { return 1.0 / p; }, Survival::by_reflectance},
    {Mistake::roulette_squared, "roulette_squared",
     "survivors of Russian roulette are divided by p twice, which is the reflectance of the surface before", both, nullptr, nullptr,
     nullptr, [](double p) { return 1.0 / p; }, Survival::by_reflectance_before},
    {Mistake::clamped, "clamped", "bright samples are clamped", both},
};

}  // namespace

std::span<const MistakeKind> mistake_kinds() { return kinds; }

}  // namespace neumann
