// What the user is told of shapes that single precision cannot tell from their place, and of
// emitters that give no light.
#include "host/flatten/device_scene.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/light_tables.h"
#include "host/numerics/measure.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// A room about the camera, and that shape in it.
Scene room_with(Geometry geometry, std::optional<Rgb> radiance = {}) {
    Scene scene;
    scene.materials.push_back({"", {}, DiffuseBsdf{}});
    scene.shapes = {shape_of(quad({-4, -4, -4}, {8, 0, 0}, {0, 8, 0}), 0, 0),
                    shape_of(quad({-4, -4, 4}, {8, 0, 0}, {0, 8, 0}), 0, 0),
                    shape_of(std::move(geometry), 0, 0, radiance)};
    scene.shapes[2].id = "grain", scene.shapes[2].plugin = "obj";
    scene.shapes[2].location = {"room.xml", 7};
    return scene;
}

std::vector<std::string> notes_of(const Scene& scene) { return make_device_scene(scene).notes; }

std::vector<Geometry> grains(double size) {
    glm::dvec3 place(1, 2, -3);
    return {quad(place, {size, 0, 0}, {0, size, 0.3 * size}), Sphere{place, size},
            Disk{place, {size, 0, 0}, {0, size, 0}}};
}

} // namespace

TEST_CASE("Rounding notes: every kind of shape too small for its place is named, no other is") {
    for (double size : {1.0, 1e-2, 1e-4})
        for (const Geometry& g : grains(size)) {
            CAPTURE(size, g.index());
            CHECK(notes_of(room_with(g)).empty());
        }
    for (double size : {1e-6, 1e-9, 1e-15})
        for (const Geometry& g : grains(size)) {
            CAPTURE(size, g.index());
            std::vector<std::string> notes = notes_of(room_with(g));
            REQUIRE(notes.size() == 1);
            CHECK_THAT(notes[0], Catch::StartsWith("room.xml:7: obj 'grain' is so small") &&
                                     !Catch::Contains("light"));
            notes = notes_of(room_with(g, Rgb(1 / (size * size))));
            REQUIRE(notes.size() == 1);
            CHECK_THAT(notes[0], Catch::Contains("its light on other shapes is"));
        }
    // The whole scene may be as small: then nothing is lost.
    Scene scene = room_with(grains(1)[0]);
    for (Shape& shape : scene.shapes)
        for (glm::dvec3& p : std::get<Mesh>(shape.geometry).positions)
            p *= 1e-9;
    CHECK(notes_of(scene).empty());
    CHECK(notes_of(every_kind_scene()).empty());
}

TEST_CASE("Rounding notes: a shape may be too far along any axis") {
    for (int axis = 0; axis < 3; axis++) {
        CAPTURE(axis);
        glm::dvec3 place(1e-3);
        place[axis] = 3;
        CHECK(notes_of(room_with(Sphere{place, 1e-6})).size() == 1);
        CHECK(notes_of(room_with(Disk{place, {1e-6, 0, 0}, {0, 1e-6, 0}})).size() == 1);
    }
    CHECK(notes_of(room_with(Sphere{glm::dvec3(1e-3), 1e-6})).empty());
}

TEST_CASE("Rounding notes: next to the camera nothing is rounded, but what is too small beside the "
          "scene is lost") {
    for (double size : {1e-6, 1e-12}) {
        Scene scene = room_with(Sphere{{0, 0, -4 * size}, size});
        CAPTURE(size);
        CHECK(notes_of(scene).size() == (size < 1e-11 ? 1 : 0));
    }
    Scene scene = room_with(quad({-1, -1, -2}, {1, 0, 0}, {0, 1, 0}));
    scene.shapes.push_back(shape_of(Sphere{{1e38, 0, 0}, 1e36}, 0, 0));
    std::vector<std::string> notes = notes_of(scene);
    REQUIRE(notes.size() == 3); // the walls too
    CHECK_THAT(notes[2], Catch::Contains("beside the scene"));
}

TEST_CASE("Rounding notes: most faces must be too small, not some") {
    Mesh mesh = quad({1, 2, -3}, {1, 0, 0}, {0, 1, 0});
    Mesh small = quad({1, 2, -2}, {1e-8, 0, 0}, {0, 1e-8, 0});
    auto base = static_cast<unsigned>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), small.positions.begin(), small.positions.end());
    for (const glm::uvec3& t : small.triangles)
        mesh.triangles.push_back(t + base);
    CHECK(notes_of(room_with(mesh)).empty());
    std::reverse(mesh.triangles.begin(), mesh.triangles.end()); // whichever come first
    CHECK(notes_of(room_with(mesh)).empty());
    // Of a mesh of many faces a part is looked at.
    Mesh fine;
    for (int i = 0; i < 20'000; i++) {
        Mesh face = quad({1 + 1e-7 * i, 2, -3}, {1e-7, 0, 0}, {0, 1e-7, 0});
        auto first = static_cast<unsigned>(fine.positions.size());
        fine.positions.insert(fine.positions.end(), face.positions.begin(), face.positions.end());
        for (const glm::uvec3& t : face.triangles)
            fine.triangles.push_back(t + first);
    }
    CHECK(notes_of(room_with(fine)).size() == 1);
}

TEST_CASE("Lights: an emitter of no area is named, one that does not shine is not") {
    Mesh flat = quad({1, 1, 1}, {1, 0, 0}, {2, 0, 0});
    std::vector<std::string> notes = notes_of(room_with(flat, Rgb(3)));
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::StartsWith("room.xml:7: obj 'grain' emits, but has no area"));
    CHECK(notes_of(room_with(flat, Rgb(0))).empty());
    CHECK(notes_of(room_with(flat)).empty());
    Mesh half = quad({1, 1, 1}, {1, 0, 0}, {0, 1, 0});
    half.triangles[1] = {0, 0, 2};
    CHECK(notes_of(room_with(half, Rgb(3))).empty());
}

TEST_CASE("Lights: all too dim for the image are told, one that is not keeps the others unnamed") {
    Mesh lamp = quad({1, 1, 1}, {1, 0, 0}, {0, 1, 0});
    for (double dim : {1e-50, 1e-300, 5e-324}) {
        Scene scene = room_with(lamp, Rgb(dim));
        std::vector<std::string> notes = notes_of(scene);
        REQUIRE(notes.size() == 1);
        CHECK_THAT(notes[0],
                   Catch::Contains("dimmer than the least number of an image of float32"));
        scene.shapes[1].radiance = Rgb(1);
        CHECK(notes_of(scene).empty());
    }
    Scene scene = room_with(lamp, Rgb(1e-30));
    CHECK(notes_of(scene).empty());
    scene.film.component_format = ComponentFormat::float16;
    CHECK_THAT(notes_of(scene).at(0), Catch::Contains("of float16 (6e-08)"));
    CHECK(notes_of(room_with(lamp, Rgb(0))).empty());
}

TEST_CASE("Lights: a tiny triangle's row has its edges and its area, wherever it is") {
    for (double size : {1e-5, 1e-7, 1e-10}) {
        Mesh mesh = quad({1, 2, -3}, {size, 0, 0}, {0, size, 0});
        DeviceScene scene = make_device_scene(room_with(mesh, Rgb(1 / (size * size))));
        REQUIRE(scene.lights.size() == 2);
        CHECK(scene.features.has(feature_emitter_area_tiny_triangle));
        double unit = scene.frame.scale * size, area = 0;
        for (const LightRecord& l : scene.lights) {
            CHECK(l.kind == emitter_area_tiny_triangle);
            CHECK(std::hypot(l.bx, l.by, l.bz) == Approx(unit).epsilon(0.42));
            CHECK(l.bx * l.cy - l.by * l.cx == Approx(unit * unit).epsilon(1e-5));
            CHECK(l.extra * unit * unit == Approx(1).epsilon(1e-5));
            area += l.area;
        }
        CHECK(area == Approx(unit * unit).epsilon(1e-5));
    }
}

TEST_CASE("Lights: points of a tiny triangle know how far they may be from the one that is met") {
    // Rays to the light end before it only if its points' errors reach to the plane that the
    // primitive has, whose corners are rounded each by itself.
    Random random(98);
    double farthest = 0;
    int beyond = 0;
    for (int n = 0; n < 300; n++) {
        const double size = random.log_between(1e-7, 1e-6);
        auto u = random.direction<F64>(), v = random.direction<F64>(),
             away = random.direction<F64>();
        glm::dvec3 place(1, 2, -3);
        Mesh mesh =
            quad(place, {size * u.x, size * u.y, size * u.z}, {size * v.x, size * v.y, size * v.z});
        DeviceScene scene = make_device_scene(room_with(mesh, Rgb(1)));
        for (int i = 0; i < int(scene.geometry.primitives.size()); i++) {
            int light = scene.geometry.primitives[std::size_t(i)].light;
            if (light < 0) continue;
            PrimitiveRecord p = scene.geometry.primitive(i);
            glm::dvec3 a(p.ax, p.ay, p.az), b(p.bx, p.by, p.bz), c(p.cx, p.cy, p.cz);
            glm::dvec3 normal = glm::cross(b - a, c - a);
            const LightRecord& row = scene.lights[std::size_t(light)];
            if (glm::length(normal) == 0 || row.kind != emitter_area_tiny_triangle) continue;
            normal = glm::normalize(normal);
            glm::dvec3 near = a + 0.01 * glm::length(a) * glm::dvec3(away.x, away.y, away.z);
            auto s = f32::emitter_area_tiny_triangle_sample(
                numerics::lanes_of(row), {float(near.x), float(near.y), float(near.z)},
                random.square<F32>());
            double off = std::fabs(glm::dot(normal, glm::dvec3(s.q.x, s.q.y, s.q.z) - a)),
                   told = glm::dot(glm::abs(normal),
                                   glm::dvec3(s.q_error.x, s.q_error.y, s.q_error.z));
            farthest = std::max(farthest, off / told);
            beyond += off > told;
        }
    }
    CHECK(beyond == 0);
    CHECK(farthest > 0.05); // some are rounded apart
}
