// Two faces at one place that look opposite ways: the ray hits the one whose front it sees, in
// whatever order they are, however each is cut into triangles, and through any lanes.
#include "host/catalogue/lane_traversals.h"

namespace parhelion::stress {
namespace {

using rays::Primitives;
using rays::Vector;

/// A sheet of n x n cells, u and v from the centre to the middles of its sides; `other`: cells are
/// cut along the other diagonal.
Primitives sheet(int n, const Vector& centre, const Vector& u, const Vector& v, bool other) {
    auto corner = [&](int i, int j) {
        float s = static_cast<float>(2 * i - n) / static_cast<float>(n),
              t = static_cast<float>(2 * j - n) / static_cast<float>(n);
        return rays::add(centre, rays::add(rays::scaled(u, s), rays::scaled(v, t)));
    };
    Primitives mesh;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            Vector a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                   d = corner(i, j + 1);
            mesh.push_back(other ? rays::triangle(a, b, d) : rays::triangle(a, b, c));
            mesh.push_back(other ? rays::triangle(b, c, d) : rays::triangle(a, c, d));
        }
    return mesh;
}

/// The same triangles from their other side, corners in an order of their own.
Primitives reversed(Primitives mesh, rays::Random& random) {
    for (PrimitiveRecord& p : mesh) {
        Vector v[3] = {{p.ax, p.ay, p.az}, {p.cx, p.cy, p.cz}, {p.bx, p.by, p.bz}};
        std::size_t first = random() % 3;
        p = rays::triangle(v[first], v[(first + 1) % 3], v[(first + 2) % 3]);
    }
    return mesh;
}

struct Doubled {
    Primitives front, back; ///< looks along +n, and along -n
    Vector centre, u, v, n;
};

/// Number decides the kind: turned with the same corners, or along the axes with other triangles.
Doubled doubled(rays::Random& random, int number) {
    float size = std::pow(10.f, rays::uniform(random, -2, 3));
    Doubled d;
    d.centre = rays::uniform_vector(random, -size, size);
    bool turned = number % 2 == 0;
    auto axis = static_cast<std::size_t>(number / 2 % 3);
    if (turned) {
        d.u = rays::uniform_vector(random, -size, size),
        d.v = rays::uniform_vector(random, -size, size);
    } else {
        d.u = d.v = {0, 0, 0};
        d.u[(axis + 1) % 3] = size, d.v[(axis + 2) % 3] = size * rays::uniform(random, .01f, 1);
    }
    d.n = vector_of(f32::cross3(rays::to_vec3(d.u), rays::to_vec3(d.v)));
    int cells = 1 + number % 3;
    d.front = sheet(cells, d.centre, d.u, d.v, false);
    d.back = reversed(
        turned ? d.front : sheet(1 + number / 3 % 4, d.centre, d.u, d.v, number % 4 < 2), random);
    return d;
}

/// From either side, from near and far, to a point of the sheet.
TracedRay ray_at(const Doubled& d, rays::Random& random) {
    auto on = [&](float reach) {
        return rays::add(d.centre,
                         rays::add(rays::scaled(d.u, rays::uniform(random, -reach, reach)),
                                   rays::scaled(d.v, rays::uniform(random, -reach, reach))));
    };
    double length = f64::length3(wide(rays::to_vec3(d.n)));
    auto height = static_cast<float>(std::sqrt(length) / length *
                                     std::pow(10., rays::uniform(random, -2, 1)));
    Vector o = rays::add(on(2), rays::scaled(d.n, random() % 2 ? height : -height));
    return {o, rays::subtract(on(.99f), o)};
}

} // namespace

Checks row_doubled_faces(StressRun& run) {
    rays::Random random(static_cast<unsigned>(run.seed));
    LaneTraversals traversals(run);
    std::uint64_t sheets = run.count(24, 240, 2'400), tried = 0, hit = 0, wrong = 0;
    for (std::uint64_t i = 0; i < sheets; i++) {
        Doubled d = doubled(random, static_cast<int>(i));
        bool back_first = random() % 2;
        Primitives all = back_first ? d.back : d.front;
        const Primitives& rest = back_first ? d.front : d.back;
        std::size_t first = all.size();
        all.insert(all.end(), rest.begin(), rest.end());
        traversals.upload(all);
        Bundles bundles([&](std::uint64_t) { return ray_at(d, random); });
        std::vector<TracedRay> list;
        for (std::uint64_t k = 0; k < 512; k++)
            list.push_back(bundles.ray(random, k));
        std::vector<TracedHit> hits = traversals.closest(list);
        for (std::size_t k = 0; k < list.size(); k++) {
            if (hits[k].primitive < 0) continue;
            bool is_front = (static_cast<std::size_t>(hits[k].primitive) < first) != back_first;
            bool faced =
                f64::dot3(wide(rays::to_vec3(d.n)), wide(rays::to_vec3(list[k].direction))) < 0;
            hit++, wrong += is_front != faced;
        }
        tried += list.size();
    }
    Check hits = rays_check("doubled faces: rays that hit", hit, tried);
    hits.target = static_cast<double>(tried) / 2, hits.at_least = true;
    Checks checks{rays_check("doubled faces: backs hit", wrong, hit), hits};
    for (const Check& check : traversals.checks("doubled faces"))
        checks.push_back(check);
    return checks;
}

} // namespace parhelion::stress
