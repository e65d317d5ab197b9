// The plugins of the sun and the sky by their formula: `sunsky` of Mitsuba 3, and `sunsky`, `sun`
// and `sky` of files older than 2.0, whose up is y and not z.
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"
#include "host/scene/mitsuba/sun_position.h"
#include "host/scene/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace parhelion::mitsuba {

namespace {

constexpr double aperture = 0.5358; ///< of the sun, degrees

constexpr std::array<const char*, 9> time_and_place = {
    "latitude", "longitude", "timezone", "year", "month", "day", "hour", "minute", "second"};

SunPosition read_position(Properties& p) {
    TimeAndPlace at;
    at.latitude = p.number("latitude", at.latitude);
    at.longitude = p.number("longitude", at.longitude);
    at.timezone = p.number("timezone", at.timezone);
    at.year = p.integer("year", at.year);
    at.month = p.integer("month", at.month);
    at.day = p.integer("day", at.day);
    at.hour = p.number("hour", at.hour);
    at.minute = p.number("minute", at.minute);
    at.second = p.number("second", at.second);
    return sun_position(at);
}

/// In a frame whose y is up. North and east, x and z are not the same in both versions.
glm::dvec3 direction_of(const SunPosition& sun, bool before_2_0) {
    const double level = std::sin(sun.zenith), up = std::cos(sun.zenith);
    if (before_2_0) return {std::sin(sun.azimuth) * level, up, -std::cos(sun.azimuth) * level};
    return {-std::cos(sun.azimuth) * level, up, std::sin(sun.azimuth) * level};
}

/// After `to_world`. Its own direction is one of the world.
glm::dvec3 read_sun_direction(Properties& p, const glm::dmat3& to_world) {
    const bool given = p.has("sun_direction");
    const auto* const both = std::find_if(time_and_place.begin(), time_and_place.end(),
                                          [&](const char* name) { return p.has(name); });
    if (given && both != time_and_place.end())
        p.refuse_value("sun_direction", fmt::format("given together with \"{}\"", *both),
                       "one or the other");
    const SunPosition position = read_position(p);
    const glm::dvec3 direction = p.vector("sun_direction", glm::dvec3(0, 0, 1));
    if (!given) return direction_of(position, p.object().before_2_0);
    return glm::transpose(to_world) * unit_direction(p, "sun_direction", direction);
}

/// Axes of the frame whose y is up.
glm::dmat3 read_frame(Properties& p) {
    const glm::dmat4 to_world = p.transform("to_world");
    check_similarity(p, to_world, "the sky");
    const glm::dmat3 axes = turned_axes(p, to_world);
    return p.object().before_2_0 ? axes : glm::dmat3(axes[0], axes[2], -axes[1]);
}

/// What all of them have.
SunskyEmitter read_daylight(Properties& p, const Rgb& albedo) {
    SunskyEmitter e;
    e.to_world = read_frame(p);
    e.sun = read_sun_direction(p, e.to_world);
    if (e.sun.y < 0.0)
        p.note("", "the sun stands below the horizon: neither it nor the sky shines");
    e.turbidity = p.number("turbidity", e.turbidity);
    e.albedo = albedo;
    e.half_aperture = 0.5 * glm::radians(aperture);
    return e;
}

/// What files before 2.0 have, and there is no use for.
void check_old(Properties& p) {
    const double stretch = p.number("stretch", 1.0);
    if (stretch != 1.0)
        p.refuse_value("stretch", fmt::format("{}", stretch), "1, nothing below the horizon");
    if (p.has("resolution")) {
        static_cast<void>(p.integer("resolution", 1));
        p.note("resolution", "\"resolution\" is not used, nothing is made an image of");
    }
    p.note("", p.title() + " is read as the sun and the sky of Mitsuba 3, by Hosek and Wilkie: of "
                           "Mitsuba 0.x, whose sun is Preetham's, brightness and colour differ");
}

void check_extend(Properties& p) {
    if (p.boolean("extend", false))
        p.refuse_value("extend", "true", "false, nothing below the horizon");
}

/// The disk grows, its power stays.
void read_radius(Properties& p, SunskyEmitter& e) {
    constexpr double narrowest = 1e-9; // degrees
    const double scale = p.number("sun_radius_scale", 1.0);
    e.half_aperture = 0.5 * glm::radians(std::max(scale * aperture, narrowest));
}

Rgb read_albedo(Properties& p, double missing) {
    return p.color("albedo", Rgb(missing), SpectrumUse::reflectance);
}

constexpr double old_albedo = 0.2;

void refuse_new(Properties& p) {
    if (!p.object().before_2_0)
        refuse(p.location(), p.title() + " is one of files before version 2.0 (accepted: "
                                         "\"sunsky\", with a \"sun_scale\" or \"sky_scale\" of 0)");
}

Emitter read_old_sunsky(Properties& p) {
    SunskyEmitter e = read_daylight(p, read_albedo(p, old_albedo));
    const double scale = p.number("scale", 1.0);
    e.sun_scale = p.number("sun_scale", scale);
    e.sky_scale = p.number("sky_scale", scale);
    read_radius(p, e);
    check_extend(p);
    check_old(p);
    return e;
}

} // namespace

Emitter read_sunsky(Properties& p) {
    if (p.object().before_2_0) return read_old_sunsky(p);
    SunskyEmitter e = read_daylight(p, read_albedo(p, 0.3));
    e.sun_scale = p.number("sun_scale", 1.0);
    e.sky_scale = p.number("sky_scale", 1.0);
    e.half_aperture = 0.5 * glm::radians(p.number("sun_aperture", aperture));
    if (p.boolean("complex_sun", false))
        p.refuse_value("complex_sun", "true", "false, a disk that is even");
    return e;
}

Emitter read_sun(Properties& p) {
    refuse_new(p);
    SunskyEmitter e = read_daylight(p, Rgb(old_albedo));
    e.sun_scale = p.number("scale", 1.0);
    e.sky_scale = 0.0;
    read_radius(p, e);
    check_old(p);
    return e;
}

Emitter read_sky(Properties& p) {
    refuse_new(p);
    SunskyEmitter e = read_daylight(p, read_albedo(p, old_albedo));
    e.sun_scale = 0.0;
    e.sky_scale = p.number("scale", 1.0);
    check_extend(p);
    check_old(p);
    return e;
}

} // namespace parhelion::mitsuba
