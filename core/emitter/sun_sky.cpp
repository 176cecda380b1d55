#include "core/emitter/sun_sky.h"

#include "core/image/display.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Columns are by the azimuth from the sun, rows by the angle from the zenith; the horizon is a row.
EnvironmentMap map_of(const SkyModel& sky, const Vec3& up, const Vec3& towards_sun) {
    constexpr int width = 360, height = 181, horizon = height / 2;
    const double sin_elevation = glm::dot(up, towards_sun),
                 cos_elevation = std::sqrt(std::max(1.0 - sin_elevation * sin_elevation, 0.0));
    Image image(width, height);
    for (int y = 0; y <= horizon; ++y)
        for (int x = 0; x < width; ++x) {
            const double theta = 0.5 * pi * y / horizon, azimuth = 2.0 * pi * ((x + 0.5) / width - 0.5);
            const double cos_theta = y == horizon ? 0.0 : std::cos(theta);
            image.at(x, y) =
                sky.radiance(cos_theta, cos_elevation * std::sin(theta) * std::cos(azimuth) + sin_elevation * cos_theta);
        }
    const Vec3 level = towards_sun - up * sin_elevation;
    const Vec3 ahead = cos_elevation > 1e-6 ? glm::normalize(level) : Frame(up).s;
    const Vec3 left = glm::cross(up, ahead);
    return {std::move(image), 1.0,
            Mat4(glm::dvec4(left, 0.0), glm::dvec4(up, 0.0), glm::dvec4(ahead, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0))};
}

}  // namespace

SunSky::SunSky(const Vec3& up, const Vec3& towards_sun, const SkyModel& sky, double sky_scale, const Rgb& sun, double sun_radius)
    : up_(up),
      around_sun_(towards_sun),
      sky_(sky),
      sky_scale_(sky_scale),
      sun_(sun),
      cos_radius_(std::cos(sun_radius)),
      solid_angle_(2.0 * pi * (1.0 - cos_radius_)),
      map_(map_of(sky, up, towards_sun)),
      largest_(sky.largest() * sky_scale + sun) {
    const double of_sky = map_.brightness() * sky_scale, of_sun = luminance(sun) * solid_angle_ * 0.25 * inv_pi;
    brightness_ = of_sky + of_sun;
    // The sun is chosen half by power and half evenly, as lights are: in its shadow only the sky gives light.
    sun_share_ = of_sun == 0.0 ? 0.0 : of_sky == 0.0 ? 1.0 : 0.5 * (0.5 + of_sun / brightness_);
}

bool SunSky::is_in_sun(const Vec3& w) const { return glm::dot(around_sun_.n, w) >= cos_radius_; }

Rgb SunSky::radiance(const Vec3& w) const {
    const double cos_theta = glm::dot(up_, w);
    if (cos_theta < 0.0) return Rgb(0.0);
    Rgb result = is_in_sun(w) ? sun_ : Rgb(0.0);
    if (sky_scale_ > 0.0) result += sky_.radiance(cos_theta, glm::dot(around_sun_.n, w)) * sky_scale_;
    return result;
}

Vec3 SunSky::sample(const Vec2& u) const {
    if (u.x < sun_share_) return around_sun_.to_world(uniform_cone({u.x / sun_share_, u.y}, cos_radius_));
    return map_.sample({std::min((u.x - sun_share_) / (1.0 - sun_share_), 0x1.fffffffffffffp-1), u.y});
}

double SunSky::pdf(const Vec3& w) const {
    return (is_in_sun(w) ? sun_share_ / solid_angle_ : 0.0) + (sun_share_ < 1.0 ? (1.0 - sun_share_) * map_.pdf(w) : 0.0);
}

}  // namespace neumann
