// Shadow rays to lights near and far: what is in the way blocks them, and nothing else does.
#include "host/catalogue/ray_rows.h"

namespace parhelion::stress {
namespace {

using rays::Vector;

/// A square of two triangles about `centre`; u, v: half its sides.
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
    f32::Primitive p = primitive_of(mesh[triangle]);
    p.flags = geometry_triangle;
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
    f32::vec3 o = leaving_point(s, e.wi);
    f32::vec3 q = f32::leave_surface(e.q, f32::surface_clearance(e.q_error, e.q_normal), e.q_normal,
                                     f32::neg3(e.wi));
    TracedRay ray{vector_of(o), vector_of(f32::sub3(q, o))};
    ray.t_max = f32::shadow_ray_end();
    ray.excluded = primitive;
    return ray;
}

} // namespace

Checks row_occlusion(StressRun& run) {
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
                run.traversal().upload(room.mesh);
                auto ray = [&](std::uint64_t i) {
                    auto from = static_cast<int>(random.bits() % 2);
                    return shadow_ray(point_of(room.mesh, from, random), from,
                                      light_of(room, i % 2 == 0, random), random);
                };
                in_batches(per_room, ray, [&](const std::vector<TracedRay>& list) {
                    for (bool occluded : run.traversal().occluded(list)) {
                        lost += !blocked && occluded;
                        leaked += blocked && !occluded;
                    }
                });
                tried += per_room;
            }
        checks.push_back(
            rays_check(fmt::format("light at 1e{}: kept away by nothing", exponent), lost, tried));
        checks.push_back(
            rays_check(fmt::format("light at 1e{}: through a blind", exponent), leaked, tried));
        run.done((exponent + 7) / 13.);
    }
    checks.push_back(host_check("occlusion", run.traversal()));
    return checks;
}

} // namespace parhelion::stress
