// Rays that leave a surface: they do not hit it again, they do not fall through it, and nothing but
// what is in the way keeps light from it.
#include "host/catalogue/ray_rows.h"

namespace parhelion::stress {
namespace {

using rays::Vector;

/// With what the record of a triangle keeps in `extra`.
rays::Primitives with_normals(rays::Primitives mesh) {
    for (PrimitiveRecord& p : mesh) {
        p.extra = inverse_normal_length(primitive_of(p));
        p.flags = geometry_triangle;
    }
    return mesh;
}

/// A point of a triangle, most often close to one of its sides.
f32::SurfaceInteraction some_point(const PrimitiveRecord& triangle, Random& random) {
    double b1 = random.bits() % 4 ? random.log_between(1e-9, 1e-3) : random.unit(),
           b2 = random.unit() * (1 - b1);
    if (random.bits() % 2) std::swap(b1, b2);
    return f32::surface_triangle(primitive_of(triangle), static_cast<float>(b1),
                                 static_cast<float>(b2));
}

/// About n, half of them within 1e-6 to 1 of grazing. Nearer to it rounding decides which side a
/// direction is on.
f32::vec3 some_direction(f32::vec3 n, Random& random) {
    double z = random.bits() % 2 ? random.between(1e-6, 1) : random.log_between(1e-6, 1),
           phi = random.between(0, 2 * M_PI), r = std::sqrt(1 - z * z);
    return f32::to_world(f32::frame_from_normal(n),
                         vec<F32>(r * std::cos(phi), r * std::sin(phi), z));
}

TracedRay leaving(const f32::SurfaceInteraction& s, f32::vec3 w, int primitive) {
    TracedRay ray{vector_of(leaving_point(s, w)), vector_of(w)};
    ray.excluded = primitive;
    return ray;
}

struct Sheet {
    std::string name;
    rays::Primitives mesh;
    bool closed; ///< convex, seen from outside; else flat: its triangles lie in one plane, exactly
};

/// Coordinates that floats hold exactly, so that all corners lie in one plane: z = x / 2 + y / 4.
rays::Primitives tilted_sheet(int n, float scale) {
    rays::Primitives mesh;
    int half = n / 2;
    auto corner = [&](int i, int j) {
        auto x = static_cast<float>(4 * (i - half)), y = static_cast<float>(4 * (j - half));
        return rays::scaled({x, y, x / 2 + y / 4}, scale);
    };
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            mesh.push_back(rays::triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)));
            mesh.push_back(rays::triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)));
        }
    return mesh;
}

rays::Primitives scaled_grid(float scale, const Vector& centre) {
    rays::Primitives mesh = rays::grid(16, 0);
    for (PrimitiveRecord& p : mesh)
        for (float* v : {&p.ax, &p.bx, &p.cx})
            for (int k = 0; k < 3; k++)
                v[k] = v[k] * scale + centre[k];
    return mesh;
}

/// Triangles from 1e-8 to 1e8 wide, and at the places of the leaks.
std::vector<Sheet> sheets() {
    std::vector<Sheet> list;
    for (int exponent = -8; exponent <= 8; exponent += 2) {
        auto scale = static_cast<float>(std::pow(10, exponent));
        float power = std::exp2(std::round(std::log2(scale)));
        list.push_back(
            {fmt::format("flat sheet, 1e{}", exponent), scaled_grid(power, {0, 0, 0}), false});
        list.push_back(
            {fmt::format("tilted sheet, 1e{}", exponent), tilted_sheet(16, power), false});
        list.push_back({fmt::format("convex mesh, 1e{}", exponent),
                        rays::subdivided_sphere(3, scale, {0, 0, 0}), true});
    }
    const std::pair<const char*, std::pair<float, Vector>> places[] = {
        {"(148376, 1234, -223423)", {64, {148376, 1234, -223423}}},
        {"1e6", {4096, {1e6f, -1e6f, 1e6f}}}};
    for (const auto& [name, place] : places) {
        list.push_back(
            {fmt::format("flat sheet at {}", name), scaled_grid(place.first, place.second), false});
        list.push_back({fmt::format("convex mesh at {}", name),
                        rays::subdivided_sphere(2, place.first, place.second), true});
    }
    return list;
}

struct Counts {
    std::uint64_t rays = 0, self_hits = 0, shadows = 0, not_finite = 0;
};

void count_self_hits(Traversal& traversal, const Sheet& sheet, std::uint64_t count, Random& random,
                     Counts& counts) {
    rays::Primitives mesh = with_normals(sheet.mesh);
    traversal.upload(mesh);
    Vector middle{};
    for (const PrimitiveRecord& p : mesh)
        middle = rays::add(middle,
                           rays::scaled({p.ax, p.ay, p.az}, 1.f / static_cast<float>(mesh.size())));
    auto ray = [&](std::uint64_t) {
        auto number = static_cast<int>(random.bits() % mesh.size());
        f32::SurfaceInteraction s = some_point(mesh[number], random);
        float side = static_cast<float>(random.sign());
        if (sheet.closed) // outward
            side = f32::dot3(s.ng, f32::sub3(s.p, rays::to_vec3(middle))) > 0 ? 1.f : -1.f;
        f32::vec3 w = some_direction(f32::scale3(s.ng, side), random);
        counts.not_finite += !f32::finite3(s.p) || !f32::finite3(w);
        return leaving(s, w, number);
    };
    in_batches(count, ray, [&](const std::vector<TracedRay>& list) {
        std::vector<TracedHit> hits = traversal.closest(list);
        std::vector<bool> occluded = traversal.occluded(list);
        for (std::size_t i = 0; i < list.size(); i++) {
            counts.self_hits += hits[i].primitive >= 0;
            counts.shadows += occluded[i];
        }
        counts.rays += list.size();
    });
}

} // namespace

Checks row_self_hits(StressRun& run) {
    Checks checks;
    std::vector<Sheet> list = sheets();
    std::uint64_t count = run.count(100'000, 10'000'000, 1'000'000'000) / list.size();
    Random random(run.seed);
    for (std::size_t i = 0; i < list.size(); i++) {
        Counts counts;
        count_self_hits(run.traversal(), list[i], count, random, counts);
        checks.push_back(
            rays_check(list[i].name + ": hit again by a path", counts.self_hits, counts.rays));
        checks.push_back(
            rays_check(list[i].name + ": in its own shadow", counts.shadows, counts.rays));
        checks.push_back(rays_check(list[i].name + ": not finite", counts.not_finite, counts.rays));
        run.done(static_cast<double>(i + 1) / static_cast<double>(list.size()));
    }
    checks.push_back(host_check("self-hits", run.traversal()));
    return checks;
}

} // namespace parhelion::stress
