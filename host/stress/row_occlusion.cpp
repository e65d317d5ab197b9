// Shadow rays to lights near and far, spheres within spheres, and the tree against every primitive.
#include "host/stress/rows.h"
#include "host/stress/traversal.h"

#include "host/stress/measure.h"
#include "host/stress/shapes.h"

namespace parhelion::stress {
namespace {

using rays::Vector;

Check count_check(const std::string& name, std::uint64_t value, std::uint64_t samples) {
    return {.name = name,
            .value = static_cast<double>(value),
            .target = 0,
            .unit = "rays",
            .samples = samples};
}

// -------------------------------------------------------------------------------------------
// occlusion

/// A square of two triangles about `centre` (numbers of three: edge vectors of exact halves).
void add_square(rays::Primitives& mesh, const Vector& centre, const Vector& u, const Vector& v) {
    auto corner = [&](float s, float t) {
        return rays::add(centre, rays::add(rays::scaled(u, s), rays::scaled(v, t)));
    };
    Vector a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
    mesh.push_back(rays::triangle(a, b, c));
    mesh.push_back(rays::triangle(a, c, d));
}

/// A floor, a light above it at `distance`, and perhaps a blind between them, wider than both.
struct Room {
    rays::Primitives mesh;
    bool blocked;
};

Room make_room(double distance, double size, bool blocked, double where) {
    auto side = static_cast<float>(size), height = static_cast<float>(distance);
    Room room{{}, blocked};
    add_square(room.mesh, {0, 0, 0}, {side, 0, 0}, {0, side, 0});
    add_square(room.mesh, {0, 0, height}, {side, 0, 0}, {0, -side, 0});
    float wide = 4 * (side + height);
    if (blocked)
        add_square(room.mesh, {0, 0, static_cast<float>(distance * where)}, {wide, 0, 0},
                   {0, wide, 0});
    return room;
}

/// A point of the square whose first triangle has that number, by the surface's own arithmetic.
f32::SurfaceInteraction point_of(const rays::Primitives& mesh, int triangle, Random& random) {
    const PrimitiveRecord& r = mesh[triangle];
    f32::Primitive p{};
    p.ax = r.ax, p.ay = r.ay, p.az = r.az, p.bx = r.bx, p.by = r.by, p.bz = r.bz;
    p.cx = r.cx, p.cy = r.cy, p.cz = r.cz, p.flags = geometry_triangle;
    p.extra = inverse_normal_length(p);
    double b1 = random.unit(), b2 = random.unit() * (1 - b1);
    return f32::surface_triangle(p, static_cast<float>(b1), static_cast<float>(b2));
}

/// The light of a room, whole or one of its halves.
f32::Light light_of(const Room& room, bool whole, Random& random) {
    const PrimitiveRecord& first = room.mesh[2];
    const PrimitiveRecord& r = room.mesh[whole ? 2 : 2 + random.bits() % 2];
    f32::Light l{};
    l.kind = whole ? emitter_area_parallelogram : emitter_area_triangle;
    l.ax = r.ax, l.ay = r.ay, l.az = r.az, l.bx = r.bx, l.by = r.by, l.bz = r.bz;
    l.cx = r.cx, l.cy = r.cy, l.cz = r.cz;
    if (whole) // its corner across from b, which the second half has last
        l.cx = room.mesh[3].cx, l.cy = room.mesh[3].cy, l.cz = room.mesh[3].cz;
    f32::vec3 e = {first.bx - first.ax, first.by - first.ay, first.bz - first.az};
    l.area = f32::dot3(e, e) * (whole ? 1.f : .5f);
    l.extra = 1 / f32::dot3(e, e);
    l.r = l.g = l.b = l.pmf = 1;
    return l;
}

/// As shade.cl makes them.
TracedRay shadow_ray(const f32::SurfaceInteraction& s, int primitive, const f32::Light& light,
                     Random& random) {
    f32::EmitterSample e = emitter_sample(light, s.p, random.square<F32>());
    f32::vec3 o = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, e.wi);
    f32::vec3 q = f32::leave_surface(e.q, f32::surface_clearance(e.q_error, e.q_normal), e.q_normal,
                                     f32::neg3(e.wi));
    f32::vec3 d = f32::sub3(q, o);
    TracedRay ray{{o.x, o.y, o.z}, {d.x, d.y, d.z}};
    constexpr double half_ulp = 0x1p-24;
    ray.t_max = 1 - static_cast<float>(32 * half_ulp / (1 - 32 * half_ulp)); // GAMMA(32)
    ray.excluded = primitive;
    return ray;
}

} // namespace

Checks row_occlusion(StressRun& run) {
    Traversal traversal(run.device, {.lanes = run.device.device.lanes()});
    Random random(run.seed);
    Checks checks;
    std::uint64_t per_room = run.count(2'000, 100'000, 4'000'000);
    for (int exponent = -6; exponent <= 6; exponent++) {
        std::uint64_t lost = 0, leaked = 0, tried = 0;
        for (double aspect : {0.01, 1., 100.})
            for (bool blocked : {false, true}) {
                double distance = std::pow(10, exponent);
                Room room = make_room(distance, distance * aspect, blocked,
                                      random.bits() % 2 ? 0.5 : random.log_between(1e-3, 0.999));
                Bvh bvh;
                int root = bvh_append(bvh, room.mesh);
                traversal.upload(bvh, root);
                std::vector<TracedRay> list;
                for (std::uint64_t i = 0; i < per_room; i++) {
                    auto from = static_cast<int>(random.bits() % 2);
                    list.push_back(shadow_ray(point_of(room.mesh, from, random), from,
                                              light_of(room, i % 2 == 0, random), random));
                }
                for (bool occluded : traversal.occluded(list)) {
                    lost += !blocked && occluded;
                    leaked += blocked && !occluded;
                }
                tried += list.size();
            }
        checks.push_back(
            count_check(fmt::format("light at 1e{}: kept away by nothing", exponent), lost, tried));
        checks.push_back(
            count_check(fmt::format("light at 1e{}: through a blind", exponent), leaked, tried));
        run.done((exponent + 7) / 13.);
    }
    return checks;
}

// --------------------------------------------------------------------------------------- nested
// spheres

Checks row_nested_spheres(StressRun& run) {
    Traversal traversal(run.device, {.lanes = run.device.device.lanes()});
    rays::Primitives spheres{rays::sphere({0, 0, 0}, 1), rays::sphere({0, 0, 0}, 1 + 4e-6f)};
    Bvh bvh;
    int root = bvh_append(bvh, spheres);
    traversal.upload(bvh, root);
    Random random(run.seed);
    Checks checks;
    for (bool inside : {true, false}) {
        std::vector<TracedRay> list;
        for (std::uint64_t i = 0; i < run.count(20'000, 1'000'000, 20'000'000); i++) {
            f64::vec3 at = f64::scale3(random.direction<F64>(),
                                       inside ? 0.9 * random.unit() : random.between(1.5, 4));
            f64::vec3 aim = f64::scale3(random.direction<F64>(), inside ? 2 : 0.9);
            f32::vec3 o = vec_as<F32>(at), d = vec_as<F32>(f64::normalize3(f64::sub3(aim, at)));
            list.push_back({{o.x, o.y, o.z}, {d.x, d.y, d.z}});
        }
        std::uint64_t wrong = 0;
        for (const TracedHit& hit : traversal.closest(list))
            wrong += hit.primitive != (inside ? 0 : 1);
        checks.push_back(
            count_check(inside ? "radius 1 within 1 + 4e-6: not the inner one from inside"
                               : "radius 1 within 1 + 4e-6: not the outer one from outside",
                        wrong, list.size()));
    }
    return checks;
}

// ------------------------------------------------------------------------------------------ brute
// force

Checks row_brute_force(StressRun& run) {
    Traversal traversal(run.device, {.lanes = run.device.device.lanes()});
    const std::pair<const char*, rays::Primitives> scenes[] = {
        {"closed mesh", rays::subdivided_sphere(3, 1, {0, 0, 0})},
        {"triangles, spheres, disks", rays::random_mixture(600)},
        {"needles", rays::needles(500)},
        {"repeated triangles", rays::repeated(rays::random_triangles(100, .2f), 4)},
        {"each within the last", rays::geometric_series(4, 60)}};
    Checks checks;
    for (const auto& [name, mesh] : scenes) {
        Bvh bvh;
        int root = bvh_append(bvh, mesh);
        traversal.upload(bvh, root);
        rays::Random random(static_cast<unsigned>(run.seed));
        std::vector<TracedRay> list;
        for (std::uint64_t i = 0; i < run.count(5'000, 100'000, 4'000'000); i++) {
            rays::Ray r = rays::random_ray(random, static_cast<int>(i));
            list.push_back({{r.origin[0], r.origin[1], r.origin[2]},
                            {r.direction[0], r.direction[1], r.direction[2]}});
        }
        std::vector<TracedHit> hits = traversal.closest(list);
        std::vector<bool> occluded = traversal.occluded(list);
        std::uint64_t other = 0, other_any = 0;
        for (std::size_t i = 0; i < list.size(); i++) {
            const TracedRay& r = list[i];
            rays::Hit truth =
                rays::brute_force(mesh, {{r.origin[0], r.origin[1], r.origin[2]},
                                         {r.direction[0], r.direction[1], r.direction[2]}});
            other += hits[i].primitive != truth.primitive ||
                     (truth.primitive >= 0 && hits[i].t != truth.t);
            other_any += occluded[i] != (truth.primitive >= 0);
        }
        checks.push_back(count_check(
            fmt::format("tree against every primitive, {}: other hits", name), other, list.size()));
        checks.push_back(
            count_check(fmt::format("tree against every primitive, {}: other shadows", name),
                        other_any, list.size()));
    }
    return checks;
}

} // namespace parhelion::stress
