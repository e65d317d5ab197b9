// Triangles of no area and needles among sound triangles: those of no area are never hit, what is
// behind them always is, and needles keep a mesh closed.
#include "host/catalogue/ray_rows.h"

#include <algorithm>
#include <map>

namespace parhelion::stress {
namespace {

using rays::Primitives;
using rays::Vector;

Vector corner(const PrimitiveRecord& p, int k) {
    return k == 0   ? Vector{p.ax, p.ay, p.az}
           : k == 1 ? Vector{p.bx, p.by, p.bz}
                    : Vector{p.cx, p.cy, p.cz};
}

/// Corners that coincide, on every edge of a mesh.
Primitives collapsed(const Primitives& mesh) {
    Primitives list;
    for (const PrimitiveRecord& p : mesh) {
        Vector a = corner(p, 0), b = corner(p, 1);
        for (const auto& [x, y, z] : {std::array{a, a, b}, {a, b, a}, {b, a, a}, {a, a, a}})
            list.push_back(rays::triangle(x, y, z));
    }
    return list;
}

/// Three different corners on one line, exactly: p, p + m q, p + n q of few digits.
Primitives in_line(int count, float scale, rays::Random& random) {
    auto whole = [&](int most) {
        return static_cast<float>(static_cast<int>(random() % (2 * most + 1)) - most);
    };
    Primitives list;
    while (list.size() < static_cast<std::size_t>(count)) {
        Vector p{whole(4000), whole(4000), whole(4000)}, q{whole(60), whole(60), whole(60)};
        float m = whole(12), n = whole(12);
        if (m == 0 || n == 0 || m == n) continue;
        auto at = [&](float s) {
            return rays::scaled(rays::add(p, rays::scaled(q, s)), 0x1p-12f * scale);
        };
        list.push_back(rays::triangle(at(0), at(m), at(n)));
    }
    return list;
}

/// A mesh, and triangles of no area: what stands where in both together.
struct Mixture {
    std::string name;
    float radius;
    Primitives sound, all;
    std::vector<int> number; ///< of a primitive of `all` in `sound`; -1: it has no area
};

Mixture mixture(const std::string& name, float radius, const Primitives& sound,
                const Primitives& flat, rays::Random& random) {
    std::vector<int> order(sound.size() + flat.size());
    for (std::size_t i = 0; i < order.size(); i++)
        order[i] = i < sound.size() ? static_cast<int>(i) : -static_cast<int>(i - sound.size()) - 1;
    for (std::size_t i = order.size(); i > 1; i--)
        std::swap(order[i - 1], order[random() % i]);
    Mixture m{name, radius, sound, {}, {}};
    int next = 0; // sound ones keep their order, by which equally near hits are told apart
    for (int i : order) {
        m.number.push_back(i >= 0 ? next : -1);
        m.all.push_back(i >= 0 ? sound[next++] : flat[-i - 1]);
    }
    return m;
}

std::vector<Mixture> mixtures(rays::Random& random) {
    std::vector<Mixture> list;
    for (float scale : {0x1p-20f, 1.f, 0x1p20f}) {
        Primitives mesh = rays::subdivided_sphere(3, scale, {0, 0, 0}), flat = collapsed(mesh),
                   line = in_line(400, scale, random), both = flat;
        both.insert(both.end(), line.begin(), line.end());
        list.push_back(mixture("coinciding corners alone", scale, {}, flat, random));
        list.push_back(mixture("corners in line alone", scale, {}, line, random));
        list.push_back(mixture("among sound triangles", scale, mesh, both, random));
    }
    return list;
}

struct Counts {
    std::uint64_t rays = 0, flat = 0, other = 0, other_any = 0, not_finite = 0;
};

bool finite(const TracedHit& h) {
    return std::isfinite(h.t) && std::isfinite(h.b1) && std::isfinite(h.b2);
}

/// Rays from inside at corners and edges of all triangles; judge(ray, hit, occluded) has each.
template<class Judge>
void trace(Traversal& traversal, const Primitives& mesh, float radius, std::uint64_t count,
           rays::Random& random, Judge judge) {
    traversal.upload(mesh);
    auto ray = [&](std::uint64_t i) { return aimed_ray(mesh, {radius, {0, 0, 0}}, random, i); };
    in_batches(count, ray, [&](const std::vector<TracedRay>& list) {
        std::vector<TracedHit> hits = traversal.closest(list);
        std::vector<bool> occluded = traversal.occluded(list);
        for (std::size_t i = 0; i < list.size(); i++)
            judge(list[i], hits[i], occluded[i]);
    });
}

/// Against brute force over the sound ones.
void add_mixture(Traversal& traversal, const Mixture& m, std::uint64_t count, rays::Random& random,
                 Counts& counts) {
    trace(traversal, m.all, m.radius, count, random,
          [&](const TracedRay& ray, const TracedHit& hit, bool occluded) {
              rays::Hit truth = rays::brute_force(m.sound, {ray.origin, ray.direction});
              bool found = hit.primitive >= 0;
              int number = found ? m.number[hit.primitive] : -1;
              counts.flat += found && number < 0;
              counts.other += number != truth.primitive || (number >= 0 && hit.t != truth.t);
              counts.other_any += occluded != (truth.primitive >= 0);
              counts.not_finite += found && !finite(hit);
          });
    counts.rays += count;
}

/// Each triangle of a mesh cut into three about a point next to the middle of its first side, and
/// as high above it as that is long, times `height`: as closed as the mesh was.
Primitives with_needles(const Primitives& mesh, float height) {
    Primitives list;
    for (const PrimitiveRecord& p : mesh) {
        Vector a = corner(p, 0), b = corner(p, 1), c = corner(p, 2);
        Vector middle = rays::scaled(rays::add(a, b), .5f);
        Vector d = rays::add(middle, rays::scaled(rays::subtract(c, middle), height));
        for (const auto& [x, y, z] : {std::array{a, b, d}, {b, c, d}, {c, a, d}})
            list.push_back(rays::triangle(x, y, z));
    }
    return list;
}

f64::vec3 wide_corner(const PrimitiveRecord& p, int k) { return wide(rays::to_vec3(corner(p, k))); }

double distance_to_segment(f64::vec3 p, f64::vec3 a, f64::vec3 b) {
    f64::vec3 along = f64::sub3(b, a);
    double s = f64::dot3(f64::sub3(p, a), along) / f64::dot3(along, along);
    return f64::length3(f64::sub3(p, f64::add3(a, f64::scale3(along, std::clamp(s, 0., 1.)))));
}

double distance_to_triangle(f64::vec3 p, const PrimitiveRecord& triangle) {
    f64::vec3 v[] = {wide_corner(triangle, 0), wide_corner(triangle, 1), wide_corner(triangle, 2)};
    f64::vec3 n = f64::cross3(f64::sub3(v[1], v[0]), f64::sub3(v[2], v[0]));
    bool inside = true;
    double edges = INFINITY;
    for (int k = 0; k < 3; k++) {
        f64::vec3 a = v[k], b = v[(k + 1) % 3];
        inside &= f64::dot3(f64::cross3(f64::sub3(b, a), f64::sub3(p, a)), n) >= 0;
        edges = std::min(edges, distance_to_segment(p, a, b));
    }
    return inside ? std::fabs(f64::dot3(f64::sub3(p, v[0]), n)) / f64::length3(n) : edges;
}

struct NeedleCounts {
    std::uint64_t rays = 0, leaks = 0, light_leaks = 0, not_finite = 0, needles = 0;
    Worst distance; ///< of hits from what they hit, ulp of the mesh's radius
};

void add_needles(Traversal& traversal, float radius, float height, std::uint64_t count,
                 rays::Random& random, NeedleCounts& counts) {
    Primitives mesh = with_needles(rays::subdivided_sphere(3, radius, {0, 0, 0}), height);
    trace(traversal, mesh, radius, count, random,
          [&](const TracedRay& ray, const TracedHit& hit, bool occluded) {
              counts.light_leaks += !occluded;
              counts.leaks += hit.primitive < 0;
              if (hit.primitive < 0) return;
              counts.not_finite += !finite(hit);
              counts.needles += hit.primitive % 3 == 0;
              f64::vec3 o = wide(rays::to_vec3(ray.origin)), d = wide(rays::to_vec3(ray.direction));
              f64::vec3 at = f64::add3(o, f64::scale3(d, double{hit.t}));
              counts.distance.add(distance_to_triangle(at, mesh[hit.primitive]) /
                                  static_cast<double>(ulp_of<float>(radius)));
          });
    counts.rays += count;
}

Checks needle_checks(StressRun& run, rays::Random& random) {
    constexpr float heights[] = {1e-3f, 1e-5f, 1e-6f, 1e-7f};
    std::uint64_t count = run.count(2'000, 100'000, 10'000'000) / std::size(heights);
    NeedleCounts c;
    for (float radius : {0x1p-20f, 1.f, 0x1p20f})
        for (float height : heights)
            add_needles(run.traversal(), radius, height, count, random, c);
    Check far = rays_check("needles: hits from the triangle", 0, c.rays);
    far.value = c.distance.value(), far.target = 6, far.unit = "ulp of the mesh's radius";
    Check needles = rays_check("needles: rays that hit one", c.needles, c.rays);
    needles.target = static_cast<double>(c.rays) / 100, needles.at_least = true;
    return {rays_check("needles, closed mesh: paths that leak", c.leaks, c.rays),
            rays_check("needles, closed mesh: shadow rays that leak", c.light_leaks, c.rays),
            rays_check("needles: not finite", c.not_finite, c.rays), far, needles};
}

} // namespace

Checks row_degenerate_triangles(StressRun& run) {
    rays::Random random(static_cast<unsigned>(run.seed));
    std::uint64_t count = run.count(1'000, 15'000, 1'000'000);
    std::map<std::string, Counts> found;
    for (const Mixture& m : mixtures(random))
        add_mixture(run.traversal(), m, count, random, found[m.name]);
    Checks checks;
    for (const auto& [name, c] : found) {
        checks.push_back(rays_check("no area, " + name + ": hit", c.flat, c.rays));
        checks.push_back(rays_check("no area, " + name + ": other hits", c.other, c.rays));
        checks.push_back(rays_check("no area, " + name + ": other shadows", c.other_any, c.rays));
        checks.push_back(rays_check("no area, " + name + ": not finite", c.not_finite, c.rays));
    }
    run.done(0.5);
    for (const Check& check : needle_checks(run, random))
        checks.push_back(check);
    checks.push_back(host_check("no area and needles", run.traversal()));
    return checks;
}

} // namespace parhelion::stress
