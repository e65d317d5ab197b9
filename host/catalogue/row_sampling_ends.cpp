// Every sampling routine at the ends of its random numbers, 0 and 1 - 2^-24, in all combinations,
// and between them: what it returns is finite, and has a density unless there is no sample.
#include "host/catalogue/ends.h"
#include "host/catalogue/rows.h"

#include "host/flatten/filter_table.h"
#include "host/flatten/kind_names.h"
#include "host/twin/device_functions.h"

#include <fmt/format.h>

#include <functional>
#include <map>

#include "host/numerics/materials.h"

namespace parhelion::stress {
namespace {

using f32::vec2;
using f32::vec3;

struct Found {
    std::uint64_t tried = 0, wrong = 0;
    std::string worst_at;

    void add(bool right, const std::function<std::string()>& where) {
        tried++;
        if (!right && wrong++ == 0) worst_at = where();
    }
};

using Findings = std::map<std::string, Found>;

std::string text(vec3 v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

bool unit_length(vec3 v) { return std::fabs(double{f32::length3(v)} - 1) < 1e-5; }
bool none_negative(vec3 v) { return v.x >= 0 && v.y >= 0 && v.z >= 0; }

/// No sample; or a direction, a weight and a density.
bool right(const f32::BsdfSample& s) {
    if (!(s.pdf > 0)) return s.pdf == 0 && f32::max_component(s.weight) == 0;
    return f32::finite3(s.wi) && f32::finite3(s.weight) && none_negative(s.weight) &&
           unit_length(s.wi) && std::isfinite(s.eta) && s.eta > 0;
}

/// A direction of no length is no sample: at a point of the light itself, where no BSDF answers it.
bool right(const f32::EmitterSample& s) {
    bool lit = f32::max_component(s.weight) > 0 && f32::dot3(s.wi, s.wi) > 0;
    return f32::finite3(s.weight) && none_negative(s.weight) && std::isfinite(s.inverse_pdf) &&
           s.inverse_pdf >= 0 && f32::finite3(s.q) && f32::finite3(s.q_error) &&
           f32::finite3(s.q_normal) && f32::finite3(s.wi) && (!lit || unit_length(s.wi));
}

/// And no BSDF does.
void try_no_direction(Findings& found) {
    for (const MaterialCase& c : material_cases())
        for (vec3 wo : viewer_directions(c)) {
            f32::BsdfEval e = bsdf_eval(make_material<F32>(c), wo, {0, 0, 0});
            found["a direction of no length"].add(e.pdf == 0 && f32::finite3(e.f) &&
                                                      f32::max_component(f32::abs3(e.f)) == 0,
                                                  [&] { return c.name; });
        }
}

/// From the normal to a millionth above the horizon, and on it.
std::vector<vec3> views(const MaterialCase& c) {
    std::vector<vec3> list = viewer_directions(c);
    for (double z : {1e-4, 1e-6, 1e-20, 0.})
        for (double side : {1., -1.})
            if (side > 0 || c.transparent)
                list.push_back(f32::normalize3(vec<F32>(0.6, 0.8, side * z)));
    return list;
}

void try_materials(Ends& ends, std::uint64_t count, Findings& found) {
    for (const MaterialCase& c : material_cases()) {
        f32::Material m = make_material<F32>(c);
        for (vec3 wo : views(c))
            for (std::uint64_t i = 0; i < count; i++) {
                vec3 u = ends.numbers(i);
                f32::BsdfSample s = bsdf_sample(m, wo, vec2{u.x, u.y}, u.z);
                bool good = right(s);
                // What is sampled with a density is what eval knows, if with rounding of its own.
                if (good && s.pdf > 0 && std::isfinite(s.pdf)) {
                    f32::BsdfEval e = bsdf_eval(m, wo, s.wi);
                    good = std::isfinite(e.pdf) && e.pdf >= 0 && f32::finite3(e.f);
                }
                found[fmt::format("material {}", material_names[c.kind])].add(good, [&] {
                    return fmt::format("{}, wo {}, u {}: wi {}, weight {}, pdf {}", c.name,
                                       text(wo), text(u), text(s.wi), text(s.weight), s.pdf);
                });
            }
    }
}

vec3 perpendicular(vec3 n, int which) {
    f32::ShadingFrame f = f32::frame_from_normal(n);
    return which ? f.t : f.s;
}

/// A light of that kind, as wide as `size`, about the origin and shining along `n`.
f32::Light light_of(int kind, double size, vec3 n, double side) {
    auto s = static_cast<float>(size);
    vec3 u = f32::scale3(perpendicular(n, 0), s), v = f32::scale3(perpendicular(n, 1), s);
    f32::Light l{};
    l.kind = kind;
    l.r = 1, l.g = 2, l.b = 4, l.pmf = 0.25f;
    auto set_b = [&](vec3 b) { l.bx = b.x, l.by = b.y, l.bz = b.z; };
    auto set_c = [&](vec3 c) { l.cx = c.x, l.cy = c.y, l.cz = c.z; };
    switch (kind) {
    case emitter_area_sphere:
        l.bx = s, l.extra = static_cast<float>(side);
        l.area = static_cast<float>(4 * M_PI) * s * s;
        break;
    case emitter_area_cylinder:
        set_b(f32::scale3(n, s));
        l.cx = s, l.extra = static_cast<float>(side), l.area = static_cast<float>(2 * M_PI) * s * s;
        break;
    case emitter_area_disk:
        set_b(u), set_c(v);
        l.extra = static_cast<float>(side) / (s * s), l.area = static_cast<float>(M_PI) * s * s;
        break;
    case emitter_spot:
        set_b(n);
        l.cx = std::cos(0.5f), l.cy = 0.5f, l.cz = 1 / 0.2f, l.extra = std::cos(0.3f);
        break;
    case emitter_projector:
        set_b(n), set_c(f32::scale3(perpendicular(n, 0), 0.3f));
        l.extra = static_cast<float>(side);
        break;
    case emitter_directional:
        set_b(n);
        break;
    default: // corners
        set_b(u), set_c(v);
        l.extra = 1 / (s * s);
        l.area = s * s * (kind == emitter_area_parallelogram ? 1.f : .5f);
    }
    return l;
}

/// Lights from 1e-6 to 1e6 times as wide as far, seen from all around, from their own plane, and
/// from the points of their own surface.
void try_emitters(Ends& ends, std::uint64_t count, Findings& found) {
    for (int kind = 0; kind < emitter_kind_count; kind++)
        for (int exponent = -6; exponent <= 6; exponent++)
            for (std::uint64_t i = 0; i < count; i++) {
                Random& random = ends.random();
                vec3 n = random.direction<F32>(), p = random.direction<F32>();
                double size = std::pow(10, exponent);
                f32::Light l = light_of(kind, size, n, random.sign());
                if (i % 4 == 1) // in its plane, or next to it
                    p = f32::normalize3(
                        f32::add3(perpendicular(n, 0), f32::scale3(n, i % 8 == 1 ? 0 : 1e-7f)));
                vec3 u = ends.numbers(i / 4);
                if (i % 4 == 2) { // on its surface
                    f32::EmitterSample there = emitter_sample(l, p, vec2{u.y, u.x});
                    if (!there.distant) p = there.q;
                }
                f32::EmitterSample s = emitter_sample(l, p, vec2{u.x, u.y});
                bool good = right(s);
                float pdf = good && s.inverse_pdf > 0 ? emitter_hit(l, p, s.wi, s.q, true).pdf : 0;
                // An infinite density: q is in its own plane, and no light comes.
                good &= pdf >= 0;
                found[fmt::format("emitter {}", emitter_names[kind])].add(good, [&] {
                    return fmt::format("size {:g}, p {}, u {}: wi {}, weight {}, q {}, pdf {}",
                                       size, text(p), text(u), text(s.wi), text(s.weight),
                                       text(s.q), pdf);
                });
            }
}

void try_warps(Ends& ends, std::uint64_t count, Findings& found) {
    for (std::uint64_t i = 0; i < count; i++) {
        vec3 u = ends.numbers(i);
        vec2 u2{u.x, u.y};
        auto where = [&] { return "u " + text(u); };
        vec3 h = f32::hemisphere_cosine(u2), w = f32::sphere_uniform(u2);
        vec2 d = f32::disk_uniform(u2), b = f32::triangle_uniform(u2);
        found["hemisphere_cosine"].add(f32::finite3(h) && unit_length(h) && h.z > 0, where);
        found["sphere_uniform"].add(f32::finite3(w) && unit_length(w), where);
        found["disk_uniform"].add(std::hypot(d.x, d.y) < 1 + 2e-7, where);
        found["triangle_uniform"].add(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1, where);
        Random& random = ends.random();
        vec3 wo = random.direction<F32>();
        wo.z = std::fabs(wo.z) * static_cast<float>(random.log_between(1e-7, 1));
        wo = f32::normalize3(wo);
        auto alpha = static_cast<float>(random.log_between(1e-4, 1)),
             other = random.bits() % 2 ? alpha : static_cast<float>(random.log_between(1e-4, 1));
        vec3 n = f32::ggx_sample_visible(wo, alpha, other, u2);
        found["ggx_sample_visible"].add(f32::finite3(n) && unit_length(n) && n.z >= 0, [&] {
            return fmt::format("wo {}, alpha {:.9g} {:.9g}, u {}", text(wo), alpha, other, text(u));
        });
        vec3 throughput = f32::scale3(vec<F32>(random.unit(), random.unit(), random.unit()),
                                      static_cast<float>(random.log_between(1e-30, 10)));
        f32::Roulette r = f32::russian_roulette(throughput, 1, u.x);
        found["russian_roulette"].add(
            std::isfinite(r.scale) && r.scale >= 1 && (r.alive || r.scale == 1) &&
                (u.x > 0 || r.alive || f32::max_component(throughput) == 0),
            [&] { return fmt::format("throughput {}, u {}", text(throughput), u.x); });
    }
}

f32::Light triangle_light(vec3 a, vec3 b, vec3 c) {
    f32::Light l{};
    l.kind = emitter_area_triangle;
    l.r = l.g = l.b = l.pmf = 1;
    l.ax = a.x, l.ay = a.y, l.az = a.z, l.bx = b.x, l.by = b.y, l.bz = b.z;
    l.cx = c.x, l.cy = c.y, l.cz = c.z;
    float twice = f32::length3(f32::cross3(f32::sub3(b, a), f32::sub3(c, a)));
    l.area = 0.5f * twice, l.extra = 1 / twice;
    return l;
}

/// Triangles seen from the origin, tiny ones and huge ones: as lights, and, up to the 6 sr that
/// directions are made for, their directions.
void try_spherical_triangles(Ends& ends, std::uint64_t count, Findings& found) {
    for (std::uint64_t i = 0; i < count; i++) {
        Random& random = ends.random();
        vec3 a = random.direction<F32>();
        auto size = static_cast<float>(random.log_between(1e-4, 1e4));
        vec3 b = f32::add3(a, f32::scale3(random.direction<F32>(), size)),
             c = f32::add3(a, f32::scale3(random.direction<F32>(), size));
        vec3 u = ends.numbers(i);
        auto where = [&] {
            return fmt::format("{}, {}, {}, u {}", text(a), text(b), text(c), text(u));
        };
        f32::EmitterSample s = emitter_sample(triangle_light(a, b, c), {0, 0, 0}, vec2{u.x, u.y});
        found["near and far triangle lights"].add(right(s), where);
        f32::SphericalTriangle t = f32::spherical_triangle(b, a, c, true);
        bool good = std::isfinite(t.solid_angle) && t.solid_angle >= 0;
        if (good && t.solid_angle >= float(SOLID_ANGLE_LEAST) && t.solid_angle <= 6) {
            vec3 w = f32::spherical_triangle_uniform(t, vec2{u.x, u.y});
            good = f32::finite3(w) && f32::length3(w) > 0;
        }
        found["spherical_triangle_uniform"].add(good, where);
    }
}

f32::Camera some_camera(Random& random) {
    f32::Camera c{};
    vec3 o = random.point<F32>(1e3), d = random.direction<F32>(), u = random.point<F32>(3e-4),
         v = random.point<F32>(3e-4), l = random.point<F32>(0.1), m = random.point<F32>(0.1);
    c.ox = o.x, c.oy = o.y, c.oz = o.z, c.dx = d.x, c.dy = d.y, c.dz = d.z;
    c.ux = u.x, c.uy = u.y, c.uz = u.z, c.vx = v.x, c.vy = v.y, c.vz = v.z;
    c.lx = l.x, c.ly = l.y, c.lz = l.z, c.mx = m.x, c.my = m.y, c.mz = m.z;
    c.near_clip = static_cast<float>(random.log_between(1e-6, 1));
    c.far_clip = c.near_clip * static_cast<float>(random.log_between(2, 1e9));
    c.focus_distance = static_cast<float>(random.log_between(1, 1e6));
    c.parallel = static_cast<float>(random.bits() & 1);
    return c;
}

void try_camera(Ends& ends, std::uint64_t count, Findings& found) {
    for (std::uint64_t i = 0; i < count; i++) {
        f32::Camera c = some_camera(ends.random());
        vec3 u = ends.numbers(i % 16);
        vec2 lens = f32::disk_uniform(vec2{u.x, u.y});
        f32::CameraRay r = camera_ray(c, vec2{u.z * 1000, u.x * 1000}, lens);
        found["camera_ray"].add(f32::finite3(r.origin) && f32::finite3(r.direction) &&
                                    unit_length(r.direction) && r.t_max >= 0,
                                [&] { return fmt::format("camera {}, u {}", i, text(u)); });
    }
}

void try_filters(Ends& ends, std::uint64_t count, Findings& found) {
    const std::pair<const char*, FilterKind> kinds[] = {
#define NAMED_FILTER(name) {#name, FilterKind::name},
        FILTER_KINDS(NAMED_FILTER)
#undef NAMED_FILTER
    };
    for (const auto& [name, kind] : kinds) {
        ReconstructionFilter filter;
        filter.kind = kind;
        std::vector<FilterBin> table = make_filter_table(filter);
        for (std::uint64_t i = 0; i < count; i++) {
            float u = ends.numbers(i).x;
            FilterOffset s = sample_filter(table, u);
            found["filter"].add(std::fabs(s.offset) <= filter_radius(filter) &&
                                    std::isfinite(s.weight),
                                [&, name = name] { return fmt::format("{}, u {:.9g}", name, u); });
        }
    }
}

} // namespace

Checks row_sampling_ends(StressRun& run) {
    Ends ends(run.seed);
    Findings found;
    std::uint64_t many = run.count(10'000, 1'000'000, 100'000'000);
    try_materials(ends, many / 1000, found);
    run.done(0.4);
    try_emitters(ends, many / 20, found);
    try_no_direction(found);
    run.done(0.6);
    try_warps(ends, many, found);
    try_spherical_triangles(ends, many, found);
    try_camera(ends, many / 10, found);
    try_filters(ends, many, found);
    Checks checks;
    for (const auto& [name, f] : found)
        checks.push_back({.name = fmt::format("ends of u, {}: not finite, or no density", name),
                          .value = static_cast<double>(f.wrong),
                          .target = 0,
                          .unit = "samples",
                          .samples = f.tried,
                          .worst_at = f.worst_at});
    return checks;
}

} // namespace parhelion::stress
