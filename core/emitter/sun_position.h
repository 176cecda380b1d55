// Where the sun stands, by Blanco-Muriel, Alarcón-Padilla, López-Moratalla and Lara-Coira, Computing the solar vector, Solar Energy
// 70(5), 2001: within half a minute of arc from 1999 to 2015, without the refraction of the air.
#pragma once

#include <chrono>

namespace neumann {

struct TimeAndPlace {
    double latitude, longitude;  // degrees, to the north and to the east
    double timezone;             // hours ahead of Universal Time
    std::chrono::year_month_day date;
    double hour, minute, second;
};

struct SunPosition {
    double zenith_angle, azimuth;  // radians; the azimuth from the north by the east
};

SunPosition sun_position(const TimeAndPlace& at);

}  // namespace neumann
