// Rows of the light table of emitters that are no surfaces.
#include "host/flatten/emitter_rows.h"

#include "host/error.h"
#include "host/flatten/light_groups.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace parhelion {
namespace {

constexpr double pi = std::numbers::pi;

double square(double v) { return v * v; }

LightRow make_row(EmitterKind kind, const Rgb& radiance) {
    LightRow row;
    row.kind = kind;
    row.radiance = radiance;
    return row;
}

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void grow(const glm::dvec3& p, double r) {
        low = glm::min(low, p - r), high = glm::max(high, p + r);
    }
    /// Half the diagonal; 1 for a scene without extent.
    double radius() const {
        double r = 0.5 * glm::length(high - low);
        return r > 0.0 && low.x <= high.x ? r : 1.0;
    }
    double distance(const glm::dvec3& p) const {
        return low.x <= high.x ? glm::length(p - glm::clamp(p, low, high)) : glm::length(p);
    }
};

/// What they are made with.
struct Surroundings {
    const SceneFrame& frame;
    const Environment& environment;
    Box box; ///< around all primitives, device units
    const std::string& file;
};

/// Place and intensity of a light without size, on the device.
///
/// From far beyond the scene its light is parallel: a light further away than 2^50 units, where
/// distances squared would soon leave the range of single precision, is brought to there, and is
/// as much less intense.
void set_point(LightRow& row, const glm::dvec3& position, const Rgb& intensity,
               const Surroundings& s) {
    constexpr int far = 50;
    glm::dvec3 from_centre = (position - s.frame.camera) - s.frame.shift;
    double distance =
        std::max({std::fabs(from_centre.x), std::fabs(from_centre.y), std::fabs(from_centre.z)});
    if (!std::isfinite(distance))
        throw InputError(
            fmt::format("{}: the distance of a point, spot or projector from the shapes is "
                        "no number (accepted: up to {:.0e})",
                        s.file, std::numeric_limits<double>::max()));
    int scale = std::ilogb(s.frame.scale);
    int nearer = distance > 0.0 ? std::max(std::ilogb(distance) + scale - far, 0) : 0;
    for (int axis = 0; axis < 3; axis++) {
        row.a[axis] = std::ldexp(from_centre[axis], scale - nearer) + 0.0;
        row.radiance[axis] = std::ldexp(intensity[axis], 2 * (scale - nearer));
    }
    row.distance = s.box.distance(row.a);
}

LightRow row_of(const PointEmitter& e, const Surroundings& s) {
    LightRow row;
    row.kind = emitter_point;
    set_point(row, e.position, e.intensity, s);
    row.etendue = 4.0 * pi;
    return row;
}

LightRow row_of(const SpotEmitter& e, const Surroundings& s) {
    LightRow row;
    row.kind = emitter_spot;
    set_point(row, e.position, e.intensity, s);
    row.b = e.direction;
    // With no transition the falloff is never evaluated: the two cosines meet.
    double transition = e.cutoff_angle - e.beam_width;
    row.c = {std::cos(e.cutoff_angle), e.cutoff_angle, transition > 0.0 ? 1.0 / transition : 0.0};
    row.extra = std::cos(e.beam_width);
    row.etendue = 2.0 * pi * (1.0 - std::cos(0.5 * (e.cutoff_angle + e.beam_width)));
    return row;
}

/// Width over height, less than 0 where it is mirrored.
double aspect_of(const Slide& slide, const glm::dvec3& axis) {
    return glm::dot(glm::cross(axis, slide.across), slide.down) /
           glm::dot(slide.across, slide.across);
}

LightRow row_of(const ProjectorEmitter& e, const Surroundings& s) {
    LightRow row;
    row.kind = emitter_projector;
    set_point(row, e.position, pi * e.irradiance, s);
    row.b = e.direction;
    row.c = e.slide.across;
    row.extra = aspect_of(e.slide, e.direction);
    double width = 1.0 / glm::length(e.slide.across), height = 1.0 / glm::length(e.slide.down);
    row.etendue = width * height;
    row.peak = std::pow(1.0 + 0.25 * (width * width + height * height), 1.5); // in its corners
    return row;
}

LightRow row_of(const DirectionalEmitter& e, const Surroundings& s) {
    LightRow row = make_row(emitter_directional, e.irradiance);
    row.b = e.direction;
    row.etendue = pi * square(s.box.radius());
    return row;
}

LightRow row_of(const ConstantEmitter& e, const Surroundings& s) {
    LightRow row = make_row(emitter_constant, e.radiance);
    row.etendue = 4.0 * pi * pi * square(s.box.radius());
    return row;
}

LightRow row_of(const EnvmapEmitter& e, const Surroundings& s) {
    LightRow row = make_row(emitter_envmap, e.radiance);
    row.a = e.to_world[0], row.b = e.to_world[1], row.c = e.to_world[2];
    row.mean = s.environment.mean;
    row.etendue = row.mean * 4.0 * pi * pi * square(s.box.radius());
    row.peak = s.environment.peak;
    return row;
}

LightRow row_of(const SunskyEmitter& e, const Surroundings& s) {
    LightRow row = make_row(emitter_sunsky, s.environment.peak * e.radiance);
    row.a = e.to_world[0], row.b = e.to_world[1], row.c = e.to_world[2];
    row.mean = s.environment.mean;
    row.etendue = row.mean * 4.0 * pi * pi * square(s.box.radius());
    return row;
}

Box box_around(const IndexedGeometry& geometry) {
    Box box;
    for (std::size_t i = 0; i < geometry.primitives.size(); i++) {
        PrimitiveRecord p = geometry.primitive(static_cast<int>(i));
        glm::dvec3 a(p.ax, p.ay, p.az), b(p.bx, p.by, p.bz), c(p.cx, p.cy, p.cz);
        switch (p.flags & PRIMITIVE_KIND_MASK) {
        case geometry_sphere:
            box.grow(a, p.extra);
            break;
        case geometry_cylinder:
            box.grow(a, std::fabs(p.extra)), box.grow(a + b, std::fabs(p.extra));
            break;
        case geometry_disk:
            box.grow(a, std::hypot(glm::length(b), glm::length(c)));
            break;
        default:
            box.grow(a, 0.0), box.grow(b, 0.0), box.grow(c, 0.0);
        }
    }
    return box;
}

/// The frame of the slide that it shines through, and with a texture there the mean of what comes.
void set_slide(LightRow& row, const Slide& slide, int texture, const DeviceScene& device) {
    row.across = slide.across;
    row.aspect = aspect_of(slide, row.b);
    row.texture = texture;
    row.told = row.radiance;
    if (texture >= 0) row.radiance *= device.texture_means[static_cast<std::size_t>(texture)];
}

} // namespace

std::vector<LightRow> emitter_rows(const Scene& scene, const DeviceScene& device) {
    Surroundings around{device.frame, device.environment, box_around(device.geometry), scene.file};
    std::vector<LightRow> rows;
    for (std::size_t i = 0; i < scene.emitters.size(); i++) {
        const Emitter& emitter = scene.emitters[i];
        rows.push_back(std::visit([&](const auto& e) { return row_of(e, around); }, emitter));
        rows.back().group = group_of(scene.integrator.light_groups, {id_of_emitter(scene, i)});
        if (const Slide* slide = slide_of(emitter))
            set_slide(rows.back(), *slide, device.emitter_textures[i], device);
    }
    return rows;
}

} // namespace parhelion
