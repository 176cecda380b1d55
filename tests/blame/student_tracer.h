// A path tracer as students write it first, with a switch for each of their first mistakes: another one than the wrong tracer, on
// parallelograms of its own, so that it shares neither rays nor frames with neumann. Surfaces are diffuse, and black from behind.
#pragma once

#include "core/image/image.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace neumann::blame_test {

enum class Slip {
    none,
    next_no_cosine,         // uniform directions, whose weight lacks cosθ
    next_cosine_squared,    // directions by the cosine, whose weight has it again
    cosine_as_uniform,      // directions by the cosine, divided by 1/2π
    uniform_as_cosine,      // uniform directions, divided by cosθ/π
    even_theta,             // θ uniform in [0, π/2], divided by 1/2π
    half_hemisphere,        // φ in [0, π]
    whole_sphere,           // directions into the surface, too
    no_pi_next,             // by the cosine with its density left out: weight albedo/π
    albedo_squared_next,    // the albedo is in the BRDF and in the walk's throughput, and once where lamps are sampled
    white_next,             // the walk goes on without the albedo
    roulette_constant,      // Russian roulette from bounce 2 on, p = 0.7, survivors not divided
    roulette_albedo,        // p the surface's albedo, survivors not divided
    roulette_one_minus,     // p by the throughput, divided by 1 - p
    roulette_squared,       // p by the throughput, divided by p²
    emission_at_bounce_1,   // lamps that are hit count beside light samples, at bounce 1 alone
    no_samples_at_the_end,  // the last vertex of a depth limit asks no lamp
    inverse_distance,       // 1/d
    no_area,                // samples of lamps are not multiplied by its area
    over_area,              // they are divided by it
    swapped_wall,           // red and green of one wall
    half_angle              // tan(fov) in place of tan(fov/2)
};
const std::vector<Slip>& all_slips();
std::string name(Slip slip);
int first_wrong_bounce(Slip slip);

class StudentTracer {
public:
    // Direct light by points on the lamp, or by directions that hit it.
    StudentTracer(Slip slip, bool samples_lamp) : slip_(slip), samples_lamp_(samples_lamp) {}

    // The pictures of bounces 0 … i, each from paths of its own.
    std::vector<Image> sums(int resolution, int bounces, int samples, std::uint64_t seed) const;

private:
    using Numbers = std::mt19937_64;
    Rgb trace(double across, double down, int bounces, Numbers& numbers) const;
    Rgb direct_light(const Vec3& x, const Vec3& n, const Rgb& albedo, Numbers& numbers) const;
    // A direction, and the weight that the walk takes for it; none if the throughput is none.
    Vec3 next_direction(const Vec3& n, const Rgb& albedo, Rgb& weight, Numbers& numbers) const;
    bool survives(Rgb& beta, const Rgb& albedo, Numbers& numbers) const;

    Slip slip_;
    bool samples_lamp_;
};

// The room that it renders, for neumann.
Scene student_room(int resolution);

}  // namespace neumann::blame_test
