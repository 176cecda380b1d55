#include "core/reader/plugins/sun_sky.h"

#include "core/emitter/sun_position.h"
#include "core/emitter/sun_radiance.h"
#include "core/reader/plugins/color.h"
#include "core/reader/plugins/scene_lights.h"
#include "core/reader/plugins/sensors.h"
#include "core/sampling/warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann::reader {

namespace {

double read_in_range(Properties& p, const std::string& name, double missing, double least, double most) {
    const double value = p.number(name).value_or(missing);
    if (!(value >= least && value <= most))
        p.complain(name, fmt::format("{} is {}, expected at least {} and at most {}", name, value, least, most));
    return value;
}

Rgb read_albedo(Properties& p, const Context& context) {
    const Element* e = p.find("albedo", color_types);
    const Rgb albedo = e ? parse_color(p, "albedo", *e, Illuminant::d65, context.warnings) : Rgb(0.3);
    if (max_component(albedo) > 1.0)
        p.complain("albedo",
                   fmt::format("albedo is ({}, {}, {}), expected at most 1 in each channel", albedo.r, albedo.g, albedo.b));
    return albedo;
}

// The defaults are Mitsuba's example, Tokyo. `given` becomes the first of the parameters that is there.
TimeAndPlace read_time_and_place(Properties& p, std::string& given) {
    const auto number = [&](const char* name, double missing) {
        const auto value = p.number(name);
        if (value && given.empty()) given = name;
        return value.value_or(missing);
    };
    const auto integer = [&](const char* name, std::int64_t missing) {
        const auto value = p.integer(name);
        if (value && given.empty()) given = name;
        return value.value_or(missing);
    };
    TimeAndPlace at{};
    at.latitude = number("latitude", 35.6894);
    at.longitude = number("longitude", 139.6917);
    at.timezone = number("timezone", 9.0);
    if (std::abs(at.latitude) > 90.0)
        p.complain("latitude", fmt::format("latitude is {}, expected degrees from -90 to 90", at.latitude));
    const std::int64_t year = integer("year", 2010), month = integer("month", 7), day = integer("day", 10);
    using namespace std::chrono;
    const bool is_possible = year > -10000 && year < 10000 && month > 0 && month < 13 && day > 0 && day < 32;
    if (is_possible)
        at.date = std::chrono::year(static_cast<int>(year)) / static_cast<unsigned>(month) / static_cast<unsigned>(day);
    if (!is_possible || !at.date.ok())
        p.complain("day", fmt::format("there is no day {} of month {} of year {}", day, month, year), {"month", "year"});
    at.hour = number("hour", 15.0);
    at.minute = number("minute", 0.0);
    at.second = number("second", 0.0);
    return at;
}

// In Mitsuba's space of the emitter +z is up, north is −x and east is −y.
Vec3 direction_of(const SunPosition& sun) {
    return {-std::sin(sun.zenith_angle) * std::cos(sun.azimuth), -std::sin(sun.zenith_angle) * std::sin(sun.azimuth),
            std::cos(sun.zenith_angle)};
}

}  // namespace

Environment read_sunsky(Properties& p, const Context& context) {
    const double turbidity = read_in_range(p, "turbidity", 3.0, 1.0, 10.0);
    const Rgb albedo = read_albedo(p, context);
    const std::optional<Vec3> given_direction = p.point("sun_direction");
    std::string also_given;
    const TimeAndPlace at = read_time_and_place(p, also_given);
    if (given_direction && !also_given.empty())
        p.complain("sun_direction",
                   fmt::format("both sun_direction and {} are given, expected the sun's direction, or a time and a "
                               "place",
                               also_given));
    const double largest = given_direction ? max_component(glm::abs(*given_direction)) : 1.0;
    if (largest == 0.0) p.complain("sun_direction", "the direction is zero");
    const double sun_scale = read_scale(p, "sun_scale"), sky_scale = read_scale(p, "sky_scale");
    const double aperture = p.number("sun_aperture").value_or(sun_angle);
    if (!(aperture > 0.0 && aperture < 180.0))
        p.complain("sun_aperture", fmt::format("sun_aperture is {}, expected more than 0 and less than 180 degrees", aperture));
    if (p.boolean("complex_sun").value_or(false))
        p.complain("complex_sun", "complex_sun is true, expected false: the sun's disc has the same radiance everywhere");
    const Mat4 to_world = read_rigid_transform(p);
    p.number("sampling_weight");  // how often Mitsuba chooses it; changes noise only
    p.finish();

    const Vec3 up = glm::normalize(Vec3(to_world[2]));
    const Vec3 towards_sun = glm::normalize(given_direction ? *given_direction / largest
                                                            : Vec3(to_world * glm::dvec4(direction_of(sun_position(at)), 0.0)));
    const double sin_elevation = std::min(glm::dot(up, towards_sun), 1.0);
    if (sin_elevation < 0.0) {
        context.warnings.add("sunsky: the sun is below the horizon, and there is no light from the sky either, as in Mitsuba");
        return ConstantEnvironment(Rgb(0.0));
    }
    const double elevation = std::asin(sin_elevation);
    Rgb sun(0.0);
    if (sun_scale > 0.0) {
        // A disc of any size emits the same power.
        const auto solid_angle = [](double angle) { return 1.0 - std::cos(glm::radians(0.5 * angle)); };
        const Rgb found = spectrum_to_rgb(sun_spectrum(turbidity, elevation), Illuminant::equal_energy);
        sun = glm::max(found, Rgb(0.0)) * (sun_scale * solid_angle(sun_angle) / solid_angle(aperture));
        context.warnings.add("sunsky: the sun is that of Preetham, Shirley and Smits (1999) in place of Mitsuba's tables");
        if (std::min({found.r, found.g, found.b}) < 0.0)
            context.warnings.add("sunsky: the sun is redder than the colours of sRGB, cut to them");
    }
    const SkyModel sky(turbidity, albedo, elevation);
    if (sun == Rgb(0.0) && sky_scale == 0.0) return ConstantEnvironment(Rgb(0.0));
    return SunSky(up, towards_sun, sky, sky_scale, sun, glm::radians(0.5 * aperture));
}

}  // namespace neumann::reader
