// Scenes of random triangles of all shapes and sizes, up to 1e8 times as long as wide: the same
// bits through 1, 8 and 16 lanes, those of every triangle tried, and the triangles that double
// precision hits.
#include "host/bvh/bounds.h"
#include "host/catalogue/lane_traversals.h"

namespace parhelion::stress {
namespace {

using rays::Primitives;
using rays::Vector;

struct Scene {
    Primitives mesh;
    Vector size; ///< of the box that corners are in, about the origin

    Vector point(rays::Random& random, float reach) const {
        Vector v = rays::uniform_vector(random, -reach, reach);
        return {v[0] * size[0], v[1] * size[1], v[2] * size[2]};
    }
};

/// Each axis has its own scale; every third scene has few digits, so that triangles share planes.
/// Corners are shared now and then.
Scene random_scene(rays::Random& random, int number) {
    Scene s;
    for (float& side : s.size)
        side = std::pow(10.f, rays::uniform(random, -4, 4));
    auto corner = [&] {
        Vector v = s.point(random, 1);
        for (std::size_t k = 0; k < 3 && number % 3 == 0; k++)
            v[k] = std::round(v[k] / s.size[k] * 4) / 4 * s.size[k];
        return v;
    };
    std::vector<Vector> corners;
    auto some = [&] {
        if (corners.size() > 3 && random() % 3 == 0) return corners[random() % corners.size()];
        return corners.emplace_back(corner());
    };
    int count = 1 + static_cast<int>(random() % 60);
    for (int i = 0; i < count; i++) {
        Vector a = some(), b = some(), c = some();
        if (random() % 4 == 0) // a needle
            c = rays::add(b, rays::scaled(rays::subtract(c, b),
                                          std::pow(10.f, rays::uniform(random, -6, 0))));
        s.mesh.push_back(rays::triangle(a, b, c));
    }
    return s;
}

TracedRay random_ray(const Scene& s, rays::Random& random, std::uint64_t i) {
    Vector o = s.point(random, i % 3 == 0 ? 3 : 1.2f);
    const PrimitiveRecord& p = s.mesh[random() % s.mesh.size()];
    Vector a{p.ax, p.ay, p.az}, b{p.bx, p.by, p.bz};
    Vector aim = i % 4 == 0   ? a
                 : i % 4 == 1 ? rays::scaled(rays::add(a, b), .5f)
                              : s.point(random, 1);
    return {o, rays::subtract(aim, o)};
}

// ---- in double precision, of the slopes that the ray has in single precision

struct Truth {
    int primitive = -1;
    bool decided = true;
};

struct Meeting {
    int side = 0; ///< 1: hit, 0: not, -1: nobody can say
    double t = 0, doubt = 0;
};

Meeting meet(const PrimitiveRecord& p, const rays::ReadyRay& r) {
    const float corner[3][3] = {{p.ax, p.ay, p.az}, {p.bx, p.by, p.bz}, {p.cx, p.cy, p.cz}};
    double x[3], y[3], z[3], across = 0, along = 0;
    for (int k = 0; k < 3; k++) {
        double q[3];
        for (std::size_t a = 0; a < 3; a++) {
            auto axis = static_cast<std::size_t>(r.axis[a]);
            q[a] = double{corner[k][axis]} - double{r.ray.origin[axis]};
        }
        x[k] = q[0] - double{r.shear.shear_x} * q[2], y[k] = q[1] - double{r.shear.shear_y} * q[2];
        z[k] = q[2];
        across = std::max({across, std::fabs(x[k]), std::fabs(y[k])});
        along = std::max(along, std::fabs(z[k]));
    }
    double edge[3], sum = 0, weighted = 0;
    bool left = true, right = true, open = false;
    double doubt = across * (across + along) * 0x1p-42;
    for (int k = 0; k < 3; k++) {
        int i = (k + 2) % 3, j = (k + 1) % 3;
        edge[k] = x[i] * y[j] - y[i] * x[j];
        left &= edge[k] > -doubt, right &= edge[k] < doubt;
        open |= std::fabs(edge[k]) <= doubt;
        sum += edge[k], weighted += edge[k] * z[k];
    }
    Meeting m;
    if (!left && !right) return m;
    m.t = weighted / sum * double{r.shear.shear_z};
    m.doubt = 64 * 0x1p-24 * along * std::fabs(double{r.shear.shear_z});
    m.side = open || !(std::fabs(m.t) > m.doubt) ? -1 : m.t > 0;
    return m;
}

Truth truth(const Primitives& mesh, const TracedRay& ray) {
    rays::ReadyRay ready({ray.origin, ray.direction});
    Truth result;
    Meeting best{0, INFINITY, 0};
    double second = INFINITY; // as near as another can be
    for (std::size_t i = 0; i < mesh.size(); i++) {
        Meeting m = meet(mesh[i], ready);
        if (m.side < 0) result.decided = false;
        if (m.side <= 0) continue;
        if (m.t < best.t) {
            second = std::min(second, best.t - best.doubt);
            best = m, result.primitive = static_cast<int>(i);
        } else {
            second = std::min(second, m.t - m.doubt);
        }
    }
    result.decided &= result.primitive < 0 || second > best.t + best.doubt;
    return result;
}

struct Counts {
    std::uint64_t rays = 0, other = 0, other_shadows = 0, decided = 0, wrong = 0;
};

void add_scene(LaneTraversals& traversals, const Scene& s, std::uint64_t count,
               rays::Random& random, Counts& c) {
    traversals.upload(s.mesh);
    Bundles bundles([&](std::uint64_t i) { return random_ray(s, random, i); });
    std::vector<TracedRay> list;
    for (std::uint64_t i = 0; i < count; i++)
        list.push_back(bundles.ray(random, i));
    std::vector<TracedHit> hits = traversals.closest(list);
    std::vector<bool> occluded = traversals.occluded(list);
    c.rays += count;
    for (std::size_t i = 0; i < count; i++) {
        rays::Hit all = rays::brute_force(s.mesh, {list[i].origin, list[i].direction});
        c.other += hits[i].primitive != all.primitive || (all.primitive >= 0 && hits[i].t != all.t);
        c.other_shadows += occluded[i] != (all.primitive >= 0);
        Truth is = truth(s.mesh, list[i]);
        c.decided += is.decided;
        c.wrong += is.decided && hits[i].primitive != is.primitive;
    }
}

} // namespace

Checks row_random_triangles(StressRun& run) {
    rays::Random random(static_cast<unsigned>(run.seed));
    LaneTraversals traversals(run);
    std::uint64_t scenes = run.count(40, 1'000, 10'000);
    Counts c;
    for (std::uint64_t i = 0; i < scenes; i++) {
        Scene s = random_scene(random, static_cast<int>(i));
        std::erase_if(s.mesh, [](const PrimitiveRecord& p) { return !can_be_hit(p); });
        if (!s.mesh.empty()) add_scene(traversals, s, 512, random, c);
        run.done(static_cast<double>(i + 1) / static_cast<double>(scenes));
    }
    const std::string row = "random triangles";
    Check decided = rays_check(row + ": rays that double precision can decide", c.decided, c.rays);
    decided.target = static_cast<double>(c.rays) / 2, decided.at_least = true;
    Checks checks{
        rays_check(row + ": hits other than of every triangle tried", c.other, c.rays),
        rays_check(row + ": shadows other than of every triangle tried", c.other_shadows, c.rays),
        decided, rays_check(row + ": hits other than in double precision", c.wrong, c.decided)};
    for (const Check& check : traversals.checks(row))
        checks.push_back(check);
    return checks;
}

} // namespace parhelion::stress
