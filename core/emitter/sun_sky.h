// A clear sky and the sun in it (Mitsuba's `sunsky`), infinitely far away. Below the horizon it is black.
//
// Directions are drawn from a mixture: uniformly from the sun's cone, and from the sky in proportion to a map of it with one pixel
// a degree. The map is for the density alone; the radiance is that of the model.
#pragma once

#include "core/base/frame.h"
#include "core/emitter/environment_map.h"
#include "core/emitter/sky_model.h"

namespace neumann {

class SunSky {
public:
    // `up` and `towards_sun`: unit vectors, the sun not below the horizon. `sun`: the radiance of its disc, whose radius in radians
    // is `sun_radius`, below π/2. One of `sky_scale` and `sun` has to be more than 0.
    SunSky(const Vec3& up, const Vec3& towards_sun, const SkyModel& sky, double sky_scale, const Rgb& sun, double sun_radius);

    Rgb radiance(const Vec3& w) const;
    Vec3 sample(const Vec2& u) const;
    double pdf(const Vec3& w) const;
    const Rgb& largest() const { return largest_; }
    // The mean luminance; that of the sky is taken from the map.
    double brightness() const { return brightness_; }
    bool is_grey() const { return false; }

private:
    bool is_in_sun(const Vec3& w) const;

    Vec3 up_;
    Frame around_sun_;
    SkyModel sky_;
    double sky_scale_;
    Rgb sun_;
    double cos_radius_, solid_angle_;
    EnvironmentMap map_;
    double sun_share_;  // the sun's share of the directions
    Rgb largest_;
    double brightness_;
};

}  // namespace neumann
