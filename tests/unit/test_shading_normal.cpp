// Shading normals that keep to the geometry: mirror images stay above the surface, flat surfaces
// are left alone.
#include <catch2/catch.hpp>

#include "host/numerics/measure.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

struct Configuration {
    f32::vec3 ns, ng, wo;
};

/// Normals from hardly to very different, viewers from everywhere to grazing.
Configuration any_configuration(Random& random) {
    Configuration c{random.direction<F32>(), random.direction<F32>(), random.direction<F32>()};
    if (random.bits() % 2)
        c.ns = normalize3(add3(c.ng, scale3(c.ns, float(random.log_between(1e-5, 1)))));
    if (random.bits() % 3 == 0) {
        f32::vec3 flat = sub3(c.wo, scale3(c.ng, dot3(c.wo, c.ng)));
        c.wo = normalize3(add3(flat, scale3(c.ng, float(random.log_between(1e-6, 1)))));
    }
    return c;
}

} // namespace

TEST_CASE("Shading normals: viewer and mirror image are above the geometry", "[normals]") {
    Random random(31);
    int turned = 0, hidden = 0, changed = 0, apart = 0;
    Worst below, length;
    for (int n = 0; n < 500000; n++) {
        Configuration c = any_configuration(random);
        f32::ShadingSide s = shading_side(c.ns, c.ng, c.wo);
        float above = dot3(s.g, c.wo) > 0 ? 1 : -1, height = above * dot3(s.g, c.wo);
        double image = above * dot3(s.g, reflect_about(c.wo, s.n));
        below.add(std::max(0.0, 0.25 * height - image));
        hidden += height > 0 && above * dot3(s.n, c.wo) <= 0;
        length.add(std::fabs(double(length3(s.n)) - 1));
        apart += dot3(s.n, s.g) < 0;
        bool same = s.n.x == c.ns.x && s.n.y == c.ns.y && s.n.z == c.ns.z;
        turned += !same;
        // Where nothing is wrong nothing is changed.
        double before = above * dot3(s.g, reflect_about(c.wo, c.ns));
        changed += !same && before > 0.25 * height + 1e-5 && above * dot3(c.ns, c.wo) > 0;
    }
    CHECK(below.value() <= 2e-6);
    CHECK(length.value() <= 4e-7);
    CHECK(hidden == 0);
    CHECK(apart == 0);
    CHECK(changed == 0);
    CHECK(turned > 100000);
}

TEST_CASE("Shading normals: flat surfaces are left alone", "[normals]") {
    Random random(32);
    for (int n = 0; n < 100000; n++) {
        f32::vec3 normal = random.direction<F32>(), wo = random.direction<F32>(),
                  wi = random.direction<F32>();
        f32::ShadingSide s = shading_side(normal, normal, wo);
        CHECK((s.n.x == normal.x && s.n.y == normal.y && s.n.z == normal.z));
        CHECK(consistent_share(s, wi) == 1);
        CHECK(softened_share(s, wi) == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("Shading normals: light that the geometry does not see counts nothing", "[normals]") {
    Random random(33);
    int hidden = 0;
    for (int n = 0; n < 300000; n++) {
        Configuration c = any_configuration(random);
        f32::ShadingSide s = shading_side(c.ns, c.ng, c.wo);
        f32::vec3 wi = random.direction<F32>();
        bool agree = (dot3(s.n, wi) > 0) == (dot3(s.g, wi) > 0);
        hidden += !agree;
        if (!agree) {
            CHECK(consistent_share(s, wi) == 0);
            CHECK(softened_share(s, wi) == 0);
        }
        CHECK(softened_share(s, wi) >= 0);
        CHECK(softened_share(s, wi) <= 1 + 1e-6f);
    }
    CHECK(hidden > 10000);
}

TEST_CASE("Shading normals: what counts depends on the material", "[normals]") {
    f32::ShadingSide s{normalize3(f32::v3(1, 0, 2)), f32::v3(0, 0, 1)};
    f32::vec3 low = normalize3(f32::v3(1, 0, 0.1f)), below = normalize3(f32::v3(1, 0, -0.1f));
    f32::Material m{};
    for (int kind = 0; kind < material_kind_count; kind++) {
        m.kind = kind;
        float share = counted_share(s, m, low);
        bool matte = kind == material_diffuse || kind == material_roughdiffuse;
        CHECK((matte ? share > 0.2f && share < 0.3f : share == 1));
        CHECK(counted_share(s, m, below) == (kind == material_null ? 1.f : 0.f));
        // The sample is bad, and whoever counts it finds that out.
        CHECK(counted_share(s, m, f32::v3(NAN, 0, 0)) != 0);
    }
}
