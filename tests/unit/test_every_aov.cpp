// Every AOV of the list, in both precisions, where two of every shape stand: rays are those of the
// camera, what they meet is worked out here, in double, from Mitsuba's documentation of shapes and
// of `aov`. An AOV without a truth here does not compile.
#include "host/numerics/every_kind_scene.h"
#include "host/twin/sample_trace.h"
#include "tests/support/host_render.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

struct Ray {
    glm::dvec3 o, d;
};

/// What is to be known of a hit; `shape` counts from 1, 0: nothing.
struct Truth {
    double t = 1e30;
    int shape = 0, primitive = 0;
    glm::dvec3 p{0}, ng{0}, ns{0};
    glm::dvec2 uv{0};
    Rgb albedo{0};
};

/// An angle about an axis as a fraction of the full turn, in [0, 1).
double turn(double y, double x) {
    double phi = std::atan2(y, x) / (2 * std::numbers::pi);
    return phi < 0 ? phi + 1 : phi;
}

Truth meet(const Sphere& s, const Ray& r) {
    Truth h;
    glm::dvec3 f = r.o - s.center;
    double b = glm::dot(f, r.d), c = glm::dot(f, f) - s.radius * s.radius;
    if (b * b < c) return h;
    h.t = -b - std::sqrt(b * b - c);
    h.p = r.o + h.t * r.d;
    glm::dvec3 n = (h.p - s.center) / s.radius;
    h.ng = h.ns = s.flip_normals ? -n : n;
    h.uv = {turn(glm::dot(n, s.axis_y), glm::dot(n, s.axis_x)),
            std::acos(glm::dot(n, s.axis_z)) / std::numbers::pi};
    return h;
}

/// Where the ray meets the plane of `at`, u and v, in their coordinates.
Truth meet_plane(glm::dvec3 at, glm::dvec3 u, glm::dvec3 v, const Ray& r) {
    Truth h;
    glm::dvec3 n = glm::cross(u, v);
    h.t = glm::dot(at - r.o, n) / glm::dot(r.d, n);
    h.p = r.o + h.t * r.d;
    h.ng = h.ns = glm::normalize(n);
    glm::dvec3 q = h.p - at;
    h.uv = {glm::dot(glm::cross(q, v), n) / glm::dot(n, n),
            glm::dot(glm::cross(u, q), n) / glm::dot(n, n)};
    return h;
}

Truth meet(const Disk& d, const Ray& r) {
    Truth h = meet_plane(d.center, d.edge_u, d.edge_v, r);
    double radius = glm::length(h.uv);
    if (radius > 1) return {};
    h.uv = {radius, turn(h.uv.y, h.uv.x)};
    if (d.flip_normals) h.ng = h.ns = -h.ng;
    return h;
}

Truth meet(const Cylinder& c, const Ray& r) {
    double height = glm::length(c.axis), radius = glm::length(c.side);
    glm::dvec3 z = c.axis / height, x = c.side / radius, y = glm::cross(z, x), o = r.o - c.base;
    auto across = [&](glm::dvec3 v) { return glm::dvec2(glm::dot(v, x), glm::dot(v, y)); };
    glm::dvec2 from = across(o), way = across(r.d);
    double a = glm::dot(way, way), b = glm::dot(from, way) / a,
           left = b * b - (glm::dot(from, from) - radius * radius) / a;
    for (double t : {-b - std::sqrt(left), -b + std::sqrt(left)}) {
        double up = glm::dot(o + t * r.d, z);
        if (!(left > 0) || up < 0 || up > height) continue;
        Truth h;
        h.t = t;
        h.p = r.o + t * r.d;
        glm::dvec2 n = across(h.p - c.base) / radius;
        h.ng = h.ns = (c.flip_normals ? -1.0 : 1.0) * (n.x * x + n.y * y);
        h.uv = {turn(c.mirrored ? -n.y : n.y, n.x), up / height};
        return h;
    }
    return {};
}

Truth meet(const Mesh& m, const Ray& r) {
    Truth nearest;
    for (std::size_t k = 0; k < m.triangles.size(); k++) {
        const glm::uvec3& t = m.triangles[k];
        glm::dvec3 a = m.positions[t.x];
        Truth h = meet_plane(a, m.positions[t.y] - a, m.positions[t.z] - a, r);
        double b1 = h.uv.x, b2 = h.uv.y, b0 = 1 - b1 - b2;
        if (b0 < 0 || b1 < 0 || b2 < 0 || h.t > nearest.t) continue;
        nearest = h;
        nearest.primitive = static_cast<int>(k);
        if (!m.normals.empty())
            nearest.ns =
                glm::normalize(b0 * m.normals[t.x] + b1 * m.normals[t.y] + b2 * m.normals[t.z]);
        if (!m.uvs.empty()) nearest.uv = b0 * m.uvs[t.x] + b1 * m.uvs[t.y] + b2 * m.uvs[t.z];
    }
    return nearest;
}

Truth meet(const Scene& scene, const Ray& r) {
    Truth nearest;
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        Truth h = std::visit([&](const auto& g) { return meet(g, r); }, scene.shapes[i].geometry);
        if (h.t >= nearest.t) continue;
        nearest = h;
        nearest.shape = static_cast<int>(i) + 1;
        const Shape& shape = scene.shapes[i];
        bool back = glm::dot(h.ng, r.d) > 0 && shape.material_back != no_material;
        const Material& m = scene.materials[back ? shape.material_back : shape.material_front];
        nearest.albedo = std::get<DiffuseBsdf>(m.bsdf).reflectance.constant;
    }
    return nearest;
}

// One for each AOV of the list.
std::array<double, 3> truth_albedo(const Truth& h) { return {h.albedo.r, h.albedo.g, h.albedo.b}; }
std::array<double, 3> truth_sh_normal(const Truth& h) { return {h.ns.x, h.ns.y, h.ns.z}; }
std::array<double, 3> truth_geo_normal(const Truth& h) { return {h.ng.x, h.ng.y, h.ng.z}; }
std::array<double, 3> truth_position(const Truth& h) { return {h.p.x, h.p.y, h.p.z}; }
std::array<double, 3> truth_uv(const Truth& h) { return {h.uv.x, h.uv.y, 0}; }
std::array<double, 3> truth_depth(const Truth& h) { return {h.shape ? h.t : 0, 0, 0}; }
std::array<double, 3> truth_shape_index(const Truth& h) { return {double(h.shape), 0, 0}; }
std::array<double, 3> truth_prim_index(const Truth& h) { return {double(h.primitive), 0, 0}; }

struct Aov {
    const char* name;
    std::string suffixes;
    std::array<double, 3> (*truth)(const Truth&);
};
#define AOV_TRUTH(name, channels, suffixes) Aov{#name, suffixes, truth_##name},
const std::array aovs{AOVS(AOV_TRUTH)};

/// Two of every shape in a row, askew, each of its own colour. The flipped ones are seen from
/// behind: the ball absorbs there and has the colour of its front, others have another's.
Scene shapes_in_a_row() {
    Scene scene;
    scene.file = "made by the test";
    auto add = [&](Geometry geometry, std::optional<int> back = {}) {
        double n = static_cast<double>(scene.materials.size());
        scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0.1 + 0.1 * n, 0.9 - 0.1 * n, 0.5)}});
        int material = static_cast<int>(n);
        scene.shapes.push_back(shape_of(std::move(geometry), material, back.value_or(material)));
    };
    Mesh flat = quad({-2.9, -0.4, 0.2}, {0.8, 0, -0.2}, {0.1, 0.8, 0.1});
    Mesh smooth = quad({-1.9, -0.4, -0.1}, {0.8, 0.1, 0.2}, {0, 0.8, -0.1});
    for (const glm::dvec3& p : smooth.positions)
        smooth.normals.push_back(glm::normalize(p + glm::dvec3(1.5, 0, 2)));
    smooth.uvs = {{0.1, 0.2}, {0.9, 0.1}, {0.8, 1.3}, {-0.2, 0.9}};
    add(flat), add(smooth);
    glm::dvec3 z = glm::normalize(glm::dvec3(0.3, 0.8, 0.4)),
               x = glm::normalize(glm::cross(z, glm::dvec3(0, 0, 1)));
    add(Sphere{{-0.5, 0, 0}, 0.42});
    add(Sphere{{0.5, 0.05, 0}, 0.4, x, glm::cross(z, x), z, true}, no_material);
    add(Disk{{1.5, 0, 0}, {0.4, 0, 0.1}, {0, 0.4, 0}});
    add(Disk{{2.5, 0, 0}, {0.3, 0.2, 0}, {-0.1, 0.3, 0.2}, true}, 1);
    add(Cylinder{{3.3, -0.3, -0.2}, {0.3, 0.5, 0.6}, {0.25, -0.15, 0}}); // one sees into it
    add(Cylinder{{-3.3, -0.3, 0.2}, {-0.3, 0.6, 0.1}, {0.3, 0.15, 0}, true, true}, 2);
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 10, 1));
    scene.camera.fov_degrees = 360 / std::numbers::pi * std::atan(0.4);
    scene.film.width = scene.film.crop_width = 80;
    scene.film.height = scene.film.crop_height = 10;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 1;
    scene.sampler.samples_per_pixel = 1;
#define AOV_REQUEST(name, channels, suffixes)                                                      \
    scene.integrator.aovs.push_back({"x_" #name, #name, {}});
    AOVS(AOV_REQUEST)
    return scene;
}

/// Of the first sample of a pixel; distances count from the near plane, as in Mitsuba.
Ray ray_of(const Scene& scene, const DeviceScene& flat, int x, int y) {
    SampleTrace trace = trace_sample(scene, flat, x, y, 0);
    const Triple& d = trace.vertices.front().direction;
    glm::dvec3 direction = glm::normalize(glm::dvec3(d[0], d[1], d[2]));
    double to_near_plane = scene.camera.near_clip / -direction.z;
    return {glm::dvec3(0, 0, 10) + to_near_plane * direction, direction};
}

} // namespace

TEST_CASE("Every AOV of the list is what its name says", "[aov]") {
    Scene scene = shapes_in_a_row();
    DeviceScene flat = make_device_scene(scene);
    std::array<int, 9> met{};
    for (Precision precision : {Precision::single_precision, Precision::double_precision}) {
        Image image = host_render(scene, precision).image;
        for (int y = 0; y < 10; y++)
            for (int x = 0; x < 80; x++) {
                Truth truth = meet(scene, ray_of(scene, flat, x, y));
                if (precision == Precision::single_precision) met[truth.shape]++;
                CAPTURE(x, y, truth.shape);
                for (const Aov& aov : aovs) {
                    std::array<double, 3> expected = aov.truth(truth);
                    for (std::size_t c = 0; c < aov.suffixes.size(); c++) {
                        float v = find_channel(image,
                                               std::string("x_") + aov.name + "." + aov.suffixes[c])
                                      ->values[image.index(x, y)];
                        CAPTURE(aov.name, c);
                        CHECK(v == Approx(expected[c]).margin(1e-4));
                    }
                }
            }
    }
    // Enough of each, and both triangles of the meshes.
    for (int count : met)
        CHECK(count > 25);
}
