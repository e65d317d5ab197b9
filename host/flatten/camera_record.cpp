// The camera as the device reads it.
#include "host/flatten/camera_record.h"

#include "host/error.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace parhelion {
namespace {

struct Point {
    float x, y, z;
};

Point to_float(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// In the unit that the scene is rendered in, both must be numbers of single precision.
void check_lens(double radius, double focus) {
    constexpr double least = 1e-30, most = 1e30;
    if (radius <= most && (radius == 0.0 || focus >= least)) return;
    throw InputError(fmt::format("sensor plugin \"thinlens\": aperture_radius is {:.1e} and "
                                 "focus_distance {:.1e} in the unit that the scene is rendered in "
                                 "(accepted: up to {:.0e}, {:.0e} or greater)",
                                 radius, focus, most, least));
}

/// The rays of a far camera begin on a plane near the shapes: made in double, where that is as far
/// as it is.
void begin_far(CameraRecord& r, const Camera& camera, const glm::dvec2& axis,
               const SceneFrame& frame) {
    glm::dvec3 forward(camera.to_world[2]);
    Point begin = to_float((forward * frame.start - frame.shift) * frame.scale);
    r.fx = r.ox, r.fy = r.oy, r.fz = r.oz;
    r.ox = begin.x, r.oy = begin.y, r.oz = begin.z;
    r.near_clip = 0.0f;
    r.far_clip = static_cast<float>((camera.far_clip - frame.start) * frame.scale);
    r.axis_x = static_cast<float>(axis.x), r.axis_y = static_cast<float>(axis.y);
    r.start = static_cast<float>(frame.start * frame.scale);
    r.lens_shift = static_cast<float>(frame.start / camera.focus_distance);
    r.clear_share = static_cast<float>(1.0 - camera.near_clip / frame.start);
}

/// Of parallel rays; those of a far camera begin near the shapes, too.
CameraRecord parallel_record(const Camera& camera, int width, int height, const SceneFrame& frame) {
    glm::dvec3 left(camera.to_world[0]), up(camera.to_world[1]), forward(camera.to_world[2]);
    double pixel = 2.0 / width; // of camera space, in which the film is 2 wide
    glm::dvec3 step_x = -left * pixel, step_y = -up * pixel;
    glm::dvec3 corner = forward * frame.start - 0.5 * width * step_x - 0.5 * height * step_y;
    Point o = to_float((corner - frame.shift) * frame.scale), d = to_float(forward);
    Point u = to_float(step_x * frame.scale), v = to_float(step_y * frame.scale);
    CameraRecord r{};
    r.ox = o.x, r.oy = o.y, r.oz = o.z;
    r.dx = d.x, r.dy = d.y, r.dz = d.z;
    r.ux = u.x, r.uy = u.y, r.uz = u.z;
    r.vx = v.x, r.vy = v.y, r.vz = v.z;
    r.parallel = 1.0f;
    bool far = frame.start > 0.0;
    r.near_clip = far ? 0.0f : static_cast<float>(camera.near_clip * frame.scale);
    r.far_clip = static_cast<float>((camera.far_clip - frame.start) * frame.scale);
    r.start = far ? static_cast<float>((frame.start - camera.near_clip) * frame.scale) : 0.0f;
    return r;
}

} // namespace

CameraRecord camera_record(const Camera& camera, int width, int height, const SceneFrame& frame) {
    if (camera.orthographic) return parallel_record(camera, width, height, frame);
    glm::dvec3 left(camera.to_world[0]), up(camera.to_world[1]), forward(camera.to_world[2]);
    double pixel = 2.0 * std::tan(0.5 * horizontal_fov(camera, width, height)) / width;
    glm::dvec3 step_x = -left * pixel, step_y = -up * pixel;
    glm::dvec2 centre = (0.5 - camera.principal_point_offset) * glm::dvec2(width, height);
    double lens = camera.aperture_radius * frame.scale;
    double focus = camera.focus_distance * frame.scale;
    check_lens(lens, focus);
    Point o = to_float(frame.point(glm::dvec3(camera.to_world[3])));
    Point d = to_float(forward - centre.x * step_x - centre.y * step_y);
    Point u = to_float(step_x), v = to_float(step_y);
    Point l = to_float(left * lens), m = to_float(up * lens);
    CameraRecord r{};
    r.ox = o.x, r.oy = o.y, r.oz = o.z;
    r.dx = d.x, r.dy = d.y, r.dz = d.z;
    r.ux = u.x, r.uy = u.y, r.uz = u.z;
    r.vx = v.x, r.vy = v.y, r.vz = v.z;
    r.lx = l.x, r.ly = l.y, r.lz = l.z;
    r.mx = m.x, r.my = m.y, r.mz = m.z;
    r.near_clip = static_cast<float>(camera.near_clip * frame.scale);
    r.far_clip = static_cast<float>(camera.far_clip * frame.scale);
    r.focus_distance = static_cast<float>(focus);
    if (frame.start > 0.0) begin_far(r, camera, centre, frame);
    return r;
}

} // namespace parhelion
