// The kernels `intersect` and `shadow` find what trying every primitive of a real mesh finds, to
// the bit, and nothing that they were told to leave out. Other meshes: row `brute_force` of the
// catalogue.
#include "tests/support/traversal.h"

#include "host/numerics/shapes.h"
#include "host/scene/meshes/mesh_obj.h"
#include "tests/support/skip.h"

#include <filesystem>

using namespace parhelion;
using namespace parhelion::test;
using rays::Primitives;

namespace {

/// Random rays, and as many in packets that go the same way.
std::vector<rays::Ray> rays_for(int count, unsigned seed) {
    rays::Random random(seed);
    std::vector<rays::Ray> rays;
    rays.reserve(2 * static_cast<std::size_t>(count));
    for (int i = 0; i < count; i++)
        rays.push_back(rays::random_ray(random, i));
    for (int i = 0; i < count; i++) {
        rays::Ray ray = rays[static_cast<std::size_t>(i - i % 16)];
        for (float& d : ray.direction)
            d *= 1.f + .01f * static_cast<float>(i % 16);
        ray.direction[static_cast<std::size_t>(i) % 3] *= 1.02f;
        rays.push_back(ray);
    }
    return rays;
}

TestRay test_ray(const rays::Ray& r) {
    return {{r.origin[0], r.origin[1], r.origin[2]},
            {r.direction[0], r.direction[1], r.direction[2]}};
}

/// Misses of the oracle: rays whose distance (to the bit), primitive or occlusion differ.
struct Differences {
    int hits = 0, t = 0, primitive = 0, occlusion = 0;
};

Differences differences(Traversal& traversal, const std::vector<rays::Ray>& rays,
                        const std::vector<rays::Hit>& truth) {
    std::vector<TestRay> test_rays;
    test_rays.reserve(rays.size());
    for (const rays::Ray& r : rays)
        test_rays.push_back(test_ray(r));
    std::vector<TestHit> hits = traversal.closest(test_rays);
    std::vector<bool> occluded = traversal.occluded(test_rays);
    Differences d;
    for (std::size_t i = 0; i < rays.size(); i++) {
        d.hits += truth[i].primitive >= 0;
        d.t += std::bit_cast<std::uint32_t>(hits[i].t) != std::bit_cast<std::uint32_t>(truth[i].t);
        d.primitive += hits[i].primitive != truth[i].primitive;
        d.occlusion += occluded[i] != (truth[i].primitive >= 0);
    }
    return d;
}

struct Soup {
    std::string name;
    Primitives primitives;
    std::vector<rays::Ray> rays;
    std::vector<rays::Hit> truth;
    Bvh bvh;
    int root;

    Soup(const std::string& name, const Primitives& primitives, int ray_count)
        : name(name), primitives(primitives), rays(rays_for(ray_count, 77)) {
        for (const rays::Ray& r : rays)
            truth.push_back(rays::brute_force(primitives, r));
        root = bvh_append(bvh, indexed_geometry(primitives));
    }
};

void check_soups(const std::vector<Soup>& soups) {
    TestDevice d;
    for (const Variant& variant : variants) {
        Traversal traversal(d, variant);
        for (const Soup& soup : soups) {
            CAPTURE(variant.name(), soup.name);
            traversal.upload(soup.bvh, soup.root);
            Differences found = differences(traversal, soup.rays, soup.truth);
            CHECK(found.hits > static_cast<int>(soup.rays.size()) / 100);
            CHECK(found.hits < static_cast<int>(soup.rays.size()));
            CHECK(found.t == 0);
            CHECK(found.primitive == 0);
            CHECK(found.occlusion == 0);
        }
    }
}

} // namespace

TEST_CASE("Traversal on the device equals brute force on the bunny", "[device]") {
    std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(file)) {
        skip("no " + file.string() + " (Debian package glmark2-data)");
        return;
    }
    MeshData mesh = load_obj(file, true, {});
    Primitives primitives;
    auto at = [&](unsigned i) {
        glm::vec3 p(mesh.positions[i]);
        return rays::Vector{p.x, p.y, p.z};
    };
    for (const glm::uvec3& t : mesh.triangles)
        primitives.push_back(rays::triangle(at(t.x), at(t.y), at(t.z)));
    std::vector<Soup> soups;
    soups.emplace_back("bunny", primitives, 600);
    check_soups(soups);
}

TEST_CASE("A ray does not meet the primitive it leaves, nor anything beyond its end", "[device]") {
    TestDevice d;
    Primitives primitives = rays::repeated({rays::triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0})}, 2);
    primitives.push_back(rays::triangle({-1, -1, 1}, {1, -1, 1}, {0, 1, 1}));
    Bvh bvh;
    int root = bvh_append(bvh, indexed_geometry(primitives));
    const float infinity = std::numeric_limits<float>::infinity();
    std::vector<TestRay> rays = {
        {{0, 0, -1}, {0, 0, 1}, infinity, -1}, {{0, 0, -1}, {0, 0, 1}, infinity, 0},
        {{0, 0, 0}, {0, 0, 1}, infinity, -1},  {{0, 0, -1}, {0, 0, 1}, .999f, -1},
        {{0, 0, -1}, {0, 0, 1}, 1.f, -1},      {{0, 0, .5f}, {0, 0, 2}, infinity, 2}};
    const int expected[] = {0, 1, 2, -1, 0, -1};
    const float distance[] = {1, 1, 1, .999f, 1, infinity};
    for (const Variant& variant : variants) {
        Traversal traversal(d, variant);
        traversal.upload(bvh, root);
        std::vector<TestHit> hits = traversal.closest(rays);
        std::vector<bool> occluded = traversal.occluded(rays);
        for (std::size_t i = 0; i < rays.size(); i++) {
            CAPTURE(variant.name(), i);
            CHECK(hits[i].primitive == expected[i]);
            CHECK(hits[i].t == distance[i]);
            CHECK(occluded[i] == (expected[i] >= 0));
        }
    }
}
