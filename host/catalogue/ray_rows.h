// What the rows of rays share: counts that must be 0, and rays as the kernels make them.
#pragma once

#include "host/catalogue/rows.h"
#include "host/numerics/traversal.h"

#include <string>

#include "host/numerics/measure.h"
#include "host/numerics/shapes.h"

namespace parhelion::stress {

/// So many of these rays went wrong; none may.
inline Check rays_check(const std::string& name, std::uint64_t wrong, std::uint64_t samples) {
    return {.name = name,
            .value = static_cast<double>(wrong),
            .target = 0,
            .unit = "rays",
            .samples = samples};
}

/// What the kernels as C++ have answered to a row's rays, or as many of them as they were given.
inline Check host_check(const std::string& row, Traversal& traversal) {
    HostAnswers answers = traversal.take_host_answers();
    return rays_check(row + ": other bits than the device's from the kernels as C++",
                      answers.differing, answers.rays);
}

/// Calls trace with all rays make(number), a batch at a time: memory does not grow with them.
template<class Make, class Trace>
void in_batches(std::uint64_t count, Make make, Trace trace) {
    constexpr std::uint64_t batch = 1 << 17;
    std::vector<TracedRay> list;
    for (std::uint64_t first = 0; first < count; first += batch) {
        list.clear();
        for (std::uint64_t i = first; i < std::min(count, first + batch); i++)
            list.push_back(make(i));
        trace(std::as_const(list));
    }
}

inline rays::Vector vector_of(f32::vec3 v) { return {v.x, v.y, v.z}; }

/// Where a ray along w leaves the surface, as shade.cl has it.
inline f32::vec3 leaving_point(const f32::SurfaceInteraction& s, f32::vec3 w) {
    return f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, w);
}

/// Where a mesh is and how large.
struct Place {
    float radius;
    rays::Vector centre;
};

/// Ray i of many from inside a closed mesh: to a corner, to the middle of an edge, or to a point of
/// one that is as exactly on it as floats can say. The first of them start in the middle.
inline TracedRay aimed_ray(const rays::Primitives& mesh, const Place& place, rays::Random& random,
                           std::size_t i) {
    const PrimitiveRecord& p = mesh[i % mesh.size()];
    rays::Vector a{p.ax, p.ay, p.az}, b{p.bx, p.by, p.bz};
    float s = i % 3 == 0 ? 0.f : i % 3 == 1 ? .5f : rays::uniform(random, 0, 1);
    rays::Vector aim = rays::add(a, rays::scaled(rays::subtract(b, a), s)), o = place.centre;
    if (i >= mesh.size())
        o = rays::add(o, rays::uniform_vector(random, -.4f * place.radius, .4f * place.radius));
    return {o, rays::subtract(aim, o)};
}

} // namespace parhelion::stress
