// Where the sun stands, by date and place.
#pragma once

#include <cstdint>

namespace parhelion::mitsuba {

/// Local time; hours of the time zone east of Greenwich, degrees north and east.
struct TimeAndPlace {
    std::int64_t year = 2010, month = 7, day = 10;
    double hour = 15.0, minute = 0.0, second = 0.0;
    double latitude = 35.6894, longitude = 139.6917, timezone = 9.0; // Tokyo
};

/// Radians: from the zenith, and from north over east.
struct SunPosition {
    double zenith, azimuth;
};

/// To a hundredth of a degree between 1999 and 2015 (Blanco-Muriel et al. 2001, "Computing the
/// solar vector").
SunPosition sun_position(const TimeAndPlace& at);

} // namespace parhelion::mitsuba
