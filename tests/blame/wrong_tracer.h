// A path tracer with a depth limit and a switch for each of twenty classic mistakes: what `neumann blame` has to tell apart. It is
// written on its own, on the scene's geometry, so that without a mistake it is a second description of the same light.
//
// At each diffuse surface it asks the lamps for light and goes on by the cosine; where it then hits a lamp by chance, both are
// weighted by the power heuristic (Veach 1997, 9.2). Roulette (Arvo and Kirk 1990) ends walks from bounce 3 on.
#pragma once

#include "core/image/image.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace neumann::blame_test {

enum class Bug {
    none,
    missing_pi,
    extra_pi,
    no_cosine,
    cosine_squared,
    no_light_cosine,
    albedo_squared,
    albedo_missing,
    light_twice,
    no_emission,
    roulette_unweighted,
    clamped,
    two_sided_light,
    one_sided_walls,
    half_pixel,
    flipped_x,
    no_shadows,
    half_area,
    no_light_after_mirror,
    no_inverse_square,
    gamma
};

// The twenty, without `none`.
const std::vector<Bug>& all_bugs();
std::string name(Bug bug);
// The first bounce in blame_room() that is wrong; of `none`, the largest int.
int first_wrong_bounce(Bug bug);

// What a right tracer may do otherwise, at the same light.
struct Sampling {
    enum class Lamps {
        sampled,    // and hit by directions, by multiple importance sampling
        hit,        // by directions that go on, alone
        hemisphere  // by a direction of their own, uniform over the hemisphere: CS 184's -H
    };
    Lamps lamps = Lamps::sampled;
    bool roulette = true;
    bool one_stream = false;  // every pixel has the same random numbers
    bool stratified = false;  // the first numbers of a pixel's samples, each by Latin hypercube (McKay et al. 1979)
};

// For scenes of Diffuse, Conductor without Fresnel's reflectance, and Dielectric without factors, lit by surfaces that shine
// evenly, on a film with a box filter. Throws std::invalid_argument where a walk meets another material.
class WrongTracer {
public:
    WrongTracer(const Scene& scene, Bug bug, Sampling sampling = {});

    // S_0 … S_N: the pictures of bounces 0 … i, in radiance. Each is a render of its own with `samples` a pixel, independent of the
    // others; the same seed gives the same bits.
    std::vector<Image> sums(int bounces, int samples, std::uint64_t seed) const;

private:
    class Numbers;
    struct LampFace {
        Geometry::PrimitiveRef place;
        double area_before;  // of the faces in front of it in the list
    };

    Image picture(int bounces, int samples, std::uint64_t seed) const;
    Rgb trace(Vec2 position, int bounces, Numbers& numbers) const;
    Rgb direct_light(const SurfacePoint& x, const Vec3& normal, const Rgb& brdf, Numbers& numbers) const;
    Rgb light_by_hemisphere(const SurfacePoint& x, const Frame& frame, const Rgb& brdf, Numbers& numbers) const;
    SurfacePoint point_on_lamp(Numbers& numbers) const;
    double lamp_density(double distance2, double cosine) const;
    Rgb diffuse_brdf(const Rgb& albedo) const;
    double mis_weight(double density, double other) const;

    Scene scene_;
    Bug bug_;
    Sampling sampling_;
    std::vector<LampFace> lamp_;
    double lamp_area_ = 0.0;
};

// A room with walls of different colours, into which the camera looks through a wall: a tilted lamp below the ceiling whose back is
// black, a block, a sphere that is a mirror, a sphere of glass, and a thin panel that the camera sees from behind. Square pictures;
// nothing in it is symmetric.
Scene blame_room(int resolution);

}  // namespace neumann::blame_test
