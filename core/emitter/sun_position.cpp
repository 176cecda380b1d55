#include "core/emitter/sun_position.h"

#include "core/sampling/warp.h"

#include <cmath>

namespace neumann {

SunPosition sun_position(const TimeAndPlace& at) {
    using namespace std::chrono;
    const double hours = at.hour - at.timezone + (at.minute + at.second / 60.0) / 60.0;
    // Days since noon of 1 January 2000, Universal Time.
    const double days = static_cast<double>((sys_days(at.date) - sys_days(2000y / January / 1)).count()) - 0.5 + hours / 24.0;

    const double omega = 2.1429 - 0.0010394594 * days, mean_longitude = 4.8950630 + 0.017202791698 * days,
                 anomaly = 6.2400600 + 0.0172019699 * days;
    const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) + 0.00034894 * std::sin(2.0 * anomaly) - 0.0001134 -
                             0.0000203 * std::sin(omega);
    const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);
    const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)),
                 declination = std::asin(std::sin(obliquity) * std::sin(longitude));

    const double sidereal_time = 6.6974243242 + 0.0657098283 * days + hours;  // mean, at Greenwich, hours
    const double hour_angle = (sidereal_time * 15.0 + at.longitude) * pi / 180.0 - right_ascension;
    const double latitude = at.latitude * pi / 180.0;
    const double zenith_angle =
        std::acos(std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) + std::sin(declination) * std::sin(latitude));
    const double azimuth =
        std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) - std::sin(latitude) * std::cos(hour_angle));

    constexpr double earth_radius = 6371.01, astronomical_unit = 149597890.0;  // km
    const double parallax = earth_radius / astronomical_unit * std::sin(zenith_angle);
    return {zenith_angle + parallax, azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth};
}

}  // namespace neumann
