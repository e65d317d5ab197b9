// Where the sun stands, by date and place.
#include "host/scene/mitsuba/sun_position.h"

#include <cmath>
#include <numbers>

namespace parhelion::mitsuba {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Of noon in Greenwich, of the Gregorian calendar (Fliegel and Van Flandern 1968).
std::int64_t julian_day(std::int64_t year, std::int64_t month, std::int64_t day) {
    const std::int64_t shift = (month - 14) / 12; // -1 in January and February
    const std::int64_t years = year + 4800 + shift;
    return 1461 * years / 4 + 367 * (month - 2 - 12 * shift) / 12 - 3 * ((years + 100) / 100) / 4 +
           day - 32075;
}

} // namespace

SunPosition sun_position(const TimeAndPlace& at) {
    constexpr double noon_of_2000 = 2451545.0, earth_radius_in_distances = 6371.01 / 149597890.0;
    const double hours = at.hour - at.timezone + (at.minute + at.second / 60.0) / 60.0; // universal
    const double days = static_cast<double>(julian_day(at.year, at.month, at.day)) - 0.5 +
                        hours / 24.0 - noon_of_2000;

    const double node = 2.1429 - 0.0010394594 * days;
    const double mean = 4.8950630 + 0.017202791698 * days;
    const double anomaly = 6.2400600 + 0.0172019699 * days;
    const double longitude = mean + 0.03341607 * std::sin(anomaly) +
                             0.00034894 * std::sin(2.0 * anomaly) - 0.0001134 -
                             0.0000203 * std::sin(node);
    const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(node);

    const double ascension =
        std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

    const double sidereal_hours = 6.6974243242 + 0.0657098283 * days + hours;
    const double hour_angle = (sidereal_hours * 15.0 + at.longitude) * degree - ascension;
    const double latitude = at.latitude * degree;
    const double up = std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                      std::sin(declination) * std::sin(latitude);
    const double north = std::sin(declination) * std::cos(latitude) -
                         std::cos(declination) * std::cos(hour_angle) * std::sin(latitude);
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double zenith = std::atan2(std::hypot(north, east), up);
    // Seen from the surface and not from the earth's middle.
    return {zenith + earth_radius_in_distances * std::sin(zenith), std::atan2(east, north)};
}

} // namespace parhelion::mitsuba
