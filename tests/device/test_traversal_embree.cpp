// The kernel `intersect` agrees with Embree 3 in robust mode; what does not is at an edge, and
// counted.
#include "tests/support/traversal.h"

#include "host/numerics/shapes.h"
#include "host/numerics/triangle_truth.h"
#include "host/scene/meshes/mesh_obj.h"
#include "tests/support/skip.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <filesystem>

using namespace parhelion;
using namespace parhelion::test;

namespace {

class EmbreeScene {
public:
    explicit EmbreeScene(const rays::Primitives& primitives)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* corners = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), 3 * primitives.size()));
        auto* numbers = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), primitives.size()));
        for (const PrimitiveRecord& p : primitives) {
            for (float x : {p.ax, p.ay, p.az, p.bx, p.by, p.bz, p.cx, p.cy, p.cz})
                *corners++ = x;
        }
        for (unsigned i = 0; i < 3 * primitives.size(); i++)
            numbers[i] = i;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    ~EmbreeScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    TestHit closest(const TestRay& r) const {
        RTCRayHit query{};
        query.ray.org_x = r.origin[0], query.ray.org_y = r.origin[1], query.ray.org_z = r.origin[2];
        query.ray.dir_x = r.direction[0], query.ray.dir_y = r.direction[1],
        query.ray.dir_z = r.direction[2];
        query.ray.tfar = r.t_max;
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {r.t_max, 0, 0, -1};
        return {query.ray.tfar, query.hit.u, query.hit.v, static_cast<int>(query.hit.primID)};
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

/// The plane of the triangle met in double precision: distance, the smallest barycentric, and how
/// much a rounding error of the coordinates moves the distance, as a share of it.
struct Truth {
    double t, inside, sensitivity;
};
Truth truth(const PrimitiveRecord& p, const TestRay& r) {
    numerics::PlaneMeeting m = numerics::plane_meeting(p, r);
    return {m.t, m.inside, m.normal * m.to_corner / std::fabs(m.height)};
}

/// Is the ray within rounding of the triangle's border?
bool at_an_edge(const PrimitiveRecord& p, const TestRay& r) {
    Truth found = truth(p, r);
    return std::fabs(found.inside) < 1e-4 * found.sensitivity;
}

struct Agreement {
    int hits = 0, hit_differs = 0, other_primitive = 0, not_ties = 0;
    double ours = 0,
           embrees = 0; ///< largest error of a distance against double, ulps over the sensitivity
};

void judge(const rays::Primitives& primitives, const TestRay& ray, const TestHit& ours,
           const TestHit& theirs, Agreement& a) {
    auto of = [&](int i) -> const PrimitiveRecord& {
        return primitives[static_cast<std::size_t>(i)];
    };
    if (ours.primitive >= 0 && ours.primitive == theirs.primitive) {
        Truth exact = truth(of(ours.primitive), ray);
        auto error = [&](float t) {
            return std::fabs(t - exact.t) / (exact.t * 0x1p-24 * exact.sensitivity);
        };
        a.hits++;
        a.ours = std::max(a.ours, error(ours.t));
        a.embrees = std::max(a.embrees, error(theirs.t));
        return;
    }
    if (ours.primitive == theirs.primitive) return;
    if (ours.primitive < 0 || theirs.primitive < 0) {
        a.hit_differs++;
        a.not_ties += !at_an_edge(of(std::max(ours.primitive, theirs.primitive)), ray);
        return;
    }
    a.other_primitive++;
    // Neighbours that share the edge, or two surfaces at one distance.
    bool edges = at_an_edge(of(ours.primitive), ray) || at_an_edge(of(theirs.primitive), ray);
    a.not_ties += !(edges || std::fabs(ours.t - theirs.t) <= 1e-5f * theirs.t);
}

} // namespace

TEST_CASE("Traversal on the device agrees with Embree on the bunny, but for ties", "[device]") {
    std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(file)) {
        skip("no " + file.string() + " (Debian package glmark2-data)");
        return;
    }
    MeshData mesh = load_obj(file, true, {});
    rays::Primitives primitives;
    auto at = [&](unsigned i) {
        glm::vec3 p(mesh.positions[i]);
        return rays::Vector{p.x, p.y, p.z};
    };
    for (const glm::uvec3& t : mesh.triangles)
        primitives.push_back(rays::triangle(at(t.x), at(t.y), at(t.z)));
    EmbreeScene embree(primitives);

    rays::Random random(123);
    std::vector<TestRay> rays;
    for (int i = 0; i < 100000; i++) {
        rays::Ray r = rays::random_ray(random, i);
        rays.push_back({{r.origin[0], r.origin[1], r.origin[2]},
                        {r.direction[0], r.direction[1], r.direction[2]}});
    }
    TestDevice d;
    Traversal traversal(d, variants[0]);
    Bvh bvh;
    int root = bvh_append(bvh, indexed_geometry(primitives));
    traversal.upload(bvh, root);
    std::vector<TestHit> hits = traversal.closest(rays);
    Agreement a;
    for (std::size_t i = 0; i < rays.size(); i++)
        judge(primitives, rays[i], hits[i], embree.closest(rays[i]), a);
    WARN("same primitive " << a.hits << ", one misses " << a.hit_differs << ", another primitive "
                           << a.other_primitive << ", of these no ties " << a.not_ties
                           << "; error of t: " << a.ours << ", Embree " << a.embrees);
    CHECK(a.hits > 15000);
    CHECK(a.hit_differs + a.other_primitive < 100);
    CHECK(a.not_ties == 0);
    CHECK(a.ours < 8);
}
