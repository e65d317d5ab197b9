// What the host tells the device: rows of lights by their closed forms, and what the light tree
// makes of lights, by the formulas of its paper.
#include "host/flatten/light_bounds.h"
#include "host/flatten/light_rows.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/measure.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

constexpr double pi = 3.14159265358979323846;
const Rgb radiance(2, 3, 5);

Approx near(double value) { return Approx(value).epsilon(1e-6).margin(1e-6); }

void check_point(float x, float y, float z, const glm::dvec3& expected) {
    CHECK(x == near(expected.x));
    CHECK(y == near(expected.y));
    CHECK(z == near(expected.z));
}

/// A floor of 8 x 8 and what shines above it: a lamp of every kind, the emitters of the list below.
Scene lit_scene() {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"", {}, DiffuseBsdf{}});
    scene.shapes.push_back(shape_of(quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}), 0, 0));
    Mesh triangle;
    triangle.positions = {{1, 2, 0}, {2, 2, 0}, {1, 2.5, 1}};
    triangle.triangles = {{0, 1, 2}};
    scene.shapes.push_back(shape_of(triangle, 0, 0, radiance));
    scene.shapes.push_back(shape_of(quad({-1, 3, 0}, {0, 0, 2}, {1, 0, 0}), 0, 0, radiance));
    scene.shapes.push_back(shape_of(Sphere{{2, 1, 3}, 0.5}, 0, 0, radiance));
    Sphere inward{{-2, 1, 3}, 0.25};
    inward.flip_normals = true;
    scene.shapes.push_back(shape_of(inward, 0, 0, radiance));
    scene.shapes.push_back(shape_of(Disk{{0, 1, -2}, {0.5, 0, 0}, {0, 0.25, 0.1}}, 0, 0, radiance));
    scene.shapes.push_back(
        shape_of(Disk{{0, 2, -2}, {0.5, 0, 0}, {0, 0.25, 0.1}, true}, 0, 0, radiance));
    scene.emitters = {PointEmitter{{1, 2, -3}, radiance},
                      SpotEmitter{{-1, 2, -3}, {0.6, -0.8, 0}, 0.7, 0.3, radiance},
                      DirectionalEmitter{{0, -0.6, 0.8}, radiance}, ConstantEmitter{radiance}};
    return scene;
}

/// Lengths in units of the device, and places.
struct Placed {
    const SceneFrame& frame;
    glm::dvec3 at(double x, double y, double z) const {
        return (glm::dvec3(x, y, z) - frame.camera - frame.shift) * frame.scale;
    }
    glm::dvec3 along(double x, double y, double z) const {
        return glm::dvec3(x, y, z) * frame.scale;
    }
};

struct Expected {
    EmitterKind kind;
    double area, power; ///< square device units; radiance 1 in all colours together
};

std::vector<Expected> expected_rows(const SceneFrame& frame) {
    double s2 = frame.scale * frame.scale;
    // Half the diagonal of the box around everything: 8 x 3 x 8.
    double r2 = (64 + 9 + 64) / 4.0 * s2;
    double ellipse = pi * 0.5 * std::hypot(0.25, 0.1) * s2;
    auto surface = [](EmitterKind kind, double area) { return Expected{kind, area, pi * area}; };
    return {surface(emitter_area_triangle, 0.5 * std::hypot(1, 0.5) * s2),
            surface(emitter_area_parallelogram, 2 * s2),
            surface(emitter_area_sphere, 4 * pi * 0.25 * s2),
            surface(emitter_area_sphere, 4 * pi * 0.0625 * s2),
            surface(emitter_area_disk, ellipse),
            surface(emitter_area_disk, ellipse),
            {emitter_point, 0, 4 * pi * s2},
            // As of a cone half-way between beam and cutoff.
            {emitter_spot, 0, 2 * pi * (1 - std::cos(0.5)) * s2},
            {emitter_directional, 0, pi * r2},
            {emitter_constant, 0, 4 * pi * pi * r2}};
}

} // namespace

TEST_CASE("Record truths: rows of lights, their areas and shares of the power", "[truths]") {
    Scene scene = lit_scene();
    DeviceScene device = make_device_scene(scene);
    std::vector<Expected> rows = expected_rows(device.frame);
    REQUIRE(device.lights.size() == rows.size());
    double all = 0, s2 = device.frame.scale * device.frame.scale;
    for (const Expected& row : rows)
        all += row.power;
    for (std::size_t i = 0; i < rows.size(); i++) {
        INFO("row " << i);
        const LightRecord& l = device.lights[i];
        CHECK(l.kind == rows[i].kind);
        CHECK(l.area == near(rows[i].area));
        CHECK(l.pmf == near(rows[i].power / all));
        double unit = l.kind == emitter_point || l.kind == emitter_spot ? s2 : 1;
        check_point(l.r, l.g, l.b, radiance * unit);
    }
    CHECK(device.sky_light == 9);
}

TEST_CASE("Record truths: where lights are and which way they shine", "[truths]") {
    Scene scene = lit_scene();
    DeviceScene device = make_device_scene(scene);
    Placed in{device.frame};
    const auto& l = device.lights;
    REQUIRE(l.size() == 10);
    double s2 = device.frame.scale * device.frame.scale;
    check_point(l[0].ax, l[0].ay, l[0].az, in.at(1, 2, 0));
    check_point(l[0].bx, l[0].by, l[0].bz, in.at(2, 2, 0));
    check_point(l[0].cx, l[0].cy, l[0].cz, in.at(1, 2.5, 1));
    CHECK(l[0].extra * std::hypot(1, 0.5) * s2 == near(1));
    // A corner, and its neighbours so that the normal is that of the mesh: here +y.
    glm::dvec3 a(l[1].ax, l[1].ay, l[1].az), b(l[1].bx, l[1].by, l[1].bz),
        c(l[1].cx, l[1].cy, l[1].cz);
    glm::dvec3 normal = glm::cross(b - a, c - a) * double(l[1].extra);
    check_point(float(normal.x), float(normal.y), float(normal.z), {0, 1, 0});
    glm::dvec3 middle = 0.5 * (b + c), expected = in.at(-0.5, 3, 1);
    check_point(float(middle.x), float(middle.y), float(middle.z), expected);
    for (int k : {2, 3}) {
        check_point(l[k].ax, l[k].ay, l[k].az, in.at(k == 2 ? 2 : -2, 1, 3));
        CHECK(l[k].bx == near((k == 2 ? 0.5 : 0.25) * device.frame.scale));
        CHECK(l[k].extra == (k == 2 ? 1 : -1));
    }
    for (int k : {4, 5}) {
        check_point(l[k].ax, l[k].ay, l[k].az, in.at(0, k == 4 ? 1 : 2, -2));
        check_point(l[k].bx, l[k].by, l[k].bz, in.along(0.5, 0, 0));
        check_point(l[k].cx, l[k].cy, l[k].cz, in.along(0, 0.25, 0.1));
        CHECK(l[k].extra * 0.5 * std::hypot(0.25, 0.1) * s2 == near(k == 4 ? 1 : -1));
    }
    check_point(l[6].ax, l[6].ay, l[6].az, in.at(1, 2, -3));
    check_point(l[7].ax, l[7].ay, l[7].az, in.at(-1, 2, -3));
    check_point(l[7].bx, l[7].by, l[7].bz, {0.6, -0.8, 0});
    check_point(l[7].cx, l[7].cy, l[7].cz, {std::cos(0.7), 0.7, 1 / 0.4});
    CHECK(l[7].extra == near(std::cos(0.3)));
    check_point(l[8].bx, l[8].by, l[8].bz, {0, -0.6, 0.8});
    // What shines knows its row; the two halves of the parallelogram share one.
    const int rows[] = {-1, -1, 0, 1, 1, 2, 3, 4, 5};
    REQUIRE(device.geometry.primitives.size() == std::size(rows));
    for (std::size_t i = 0; i < std::size(rows); i++)
        CHECK(device.geometry.primitives[i].light == rows[i]);
}

TEST_CASE("Record truths: boxes, cones and brightness of lights for the tree", "[truths]") {
    DeviceScene device = make_device_scene(lit_scene());
    Placed in{device.frame};
    const double brightness = 10, s = device.frame.scale, s2 = s * s;
    struct Bound {
        glm::dvec3 low, high, axis;
        double cos_spread, cos_emission, intensity;
    };
    glm::dvec3 up(0, 1, 0), any(0, 0, 1), tilted = glm::normalize(glm::dvec3(0, -1, 0.5));
    glm::dvec3 disk = glm::normalize(glm::dvec3(0, -0.1, 0.25));
    const Bound bounds[] = {
        {in.at(1, 2, 0), in.at(2, 2.5, 1), tilted, 1, 0,
         0.5 * std::hypot(1, 0.5) * s2 * brightness},
        {in.at(-1, 3, 0), in.at(0, 3, 2), up, 1, 0, 2 * s2 * brightness},
        // The disk as which a sphere is seen from outside; all of it from inside.
        {in.at(1.5, 0.5, 2.5), in.at(2.5, 1.5, 3.5), any, -1, 0, pi * 0.25 * s2 * brightness},
        {in.at(-2.25, 0.75, 2.75), in.at(-1.75, 1.25, 3.25), any, -1, 0,
         4 * pi * 0.0625 * s2 * brightness},
        {in.at(-0.5, 0.75, -2.1), in.at(0.5, 1.25, -1.9), disk, 1, 0,
         pi * 0.5 * std::hypot(0.25, 0.1) * s2 * brightness},
        {in.at(-0.5, 1.75, -2.1), in.at(0.5, 2.25, -1.9), -disk, 1, 0,
         pi * 0.5 * std::hypot(0.25, 0.1) * s2 * brightness},
        {in.at(1, 2, -3), in.at(1, 2, -3), any, -1, 0, s2 * brightness},
        {in.at(-1, 2, -3), in.at(-1, 2, -3), {0.6, -0.8, 0}, std::cos(0.7), 1, s2 * brightness}};
    std::vector<std::string> notes;
    std::vector<LightRow> rows = light_rows(lit_scene(), device, notes);
    REQUIRE(rows.size() == std::size(bounds) + 2);
    CHECK(notes.empty());
    for (std::size_t i = 0; i < std::size(bounds); i++) {
        INFO("row " << i);
        LightBounds found = light_bounds(rows[i]);
        const Bound& b = bounds[i];
        CHECK(glm::length(found.low - b.low) < 1e-4 * s);
        CHECK(glm::length(found.high - b.high) < 1e-4 * s);
        if (b.cos_spread > -1) CHECK(glm::length(found.axis - b.axis) < 1e-5);
        CHECK(found.cos_spread == near(b.cos_spread));
        CHECK(found.cos_emission == b.cos_emission);
        CHECK(found.intensity == near(b.intensity));
        CHECK(found.power == power(rows[i]));
        CHECK(!found.distant);
    }
    for (std::size_t i : {8, 9}) {
        LightBounds found = light_bounds(rows[i]);
        CHECK(found.distant);
        // What a plane receives that faces it: of a sky of radiance 1, pi.
        bool sky = rows[i].kind != emitter_directional;
        CHECK(found.intensity == near(parhelion::brightness(rows[i].radiance) * (sky ? pi : 1)));
    }
}

TEST_CASE("Record truths: importance of lights, Conty Estevez and Kulla 2018", "[truths]") {
    f64::LightNode node{};
    node.cx = 1, node.cy = 2, node.cz = 3;
    node.intensity = 5, node.spread = 2; // anywhere
    // Of a point light: intensity over the square of the distance, times the cosine.
    f64::vec3 p = f64::v3(1, -2, 0), n = f64::v3(0, 0.6, 0.8);
    double d2 = 16 + 9, cosine = (4 * 0.6 + 3 * 0.8) / 5;
    CHECK(light_importance(node, p, n).to_point == Approx(5 / d2));
    CHECK(light_importance(node, p, n).to_surface == Approx(5 / d2 * cosine));
    CHECK(light_importance(node, p, f64::neg3(n)).to_surface == Approx(5 / d2 * cosine));
    // A group of half a unit's radius, seen under the sine 0.5 / 5, which shines within 60 degrees
    // of -y: cos(max(0, angle - spread)) is taken as cosine + sine of what it is seen under.
    node.radius = 0.5, node.ay = -1, node.spread = -0.5;
    double seen = 0.1, axis_cosine = 4 / 5.;
    double facing = std::min(1.0, axis_cosine - 0.5 + seen);
    CHECK(light_importance(node, p, n).to_point == Approx(5 / d2 * facing));
    CHECK(light_importance(node, p, n).to_surface ==
          Approx(5 / d2 * facing * std::min(1.0, cosine + seen)));
    // Behind it, nothing; within its sphere, its radius for the distance, and from any side.
    CHECK(light_importance(node, f64::v3(1, 6, 3), n).to_point == 0);
    f64::LightImportance inside = light_importance(node, f64::v3(1, 2.1, 3), n);
    CHECK(inside.to_point == Approx(5 / 0.25));
    CHECK(inside.to_surface == Approx(5 / 0.25));
    node.fixed = 1;
    CHECK(light_importance(node, p, n).to_point == 5);
    CHECK(light_importance(node, p, n).to_surface == 5);
}

TEST_CASE("Record truths: cylinders are lights all round", "[truths]") {
    Scene scene = lit_scene();
    Cylinder rod{{1, 1, 2}, {0, 3, 4}, {0.5, 0, 0}}, tube{{-2, 2, 1}, {0, 0, 2}, {0, 0.25, 0}};
    tube.flip_normals = true;
    scene.shapes = {scene.shapes[0], shape_of(rod, 0, 0, radiance), shape_of(tube, 0, 0, radiance)};
    scene.emitters.clear();
    DeviceScene device = make_device_scene(scene);
    Placed in{device.frame};
    double s = device.frame.scale;
    REQUIRE(device.lights.size() == 2);
    const LightRecord &a = device.lights[0], &b = device.lights[1];
    CHECK((a.kind == emitter_area_cylinder && b.kind == emitter_area_cylinder));
    check_point(a.ax, a.ay, a.az, in.at(1, 1, 2));
    check_point(a.bx, a.by, a.bz, in.along(0, 3, 4));
    CHECK(a.cx == near(0.5 * s));
    CHECK((a.extra == 1 && b.extra == -1));
    CHECK(a.area == near(2 * pi * 0.5 * 5 * s * s));
    CHECK(b.area == near(2 * pi * 0.25 * 2 * s * s));
    CHECK(a.pmf == near(5 / (5 + 1.0)));
    // Seen from the side, from where most of it is seen, a rectangle; from inside all of it.
    LightRow row{emitter_area_cylinder, {1, 2, 3}, {0, 3, 4}, {0.5, 0, 0}, radiance, 1, 5 * pi};
    CHECK(light_bounds(row).intensity == near(10 * 5 * 1.0));
    row.extra = -1;
    CHECK(light_bounds(row).intensity == near(10 * 5 * pi));
    CHECK(light_bounds(row).low.y == near(1.5));
    CHECK(light_bounds(row).high.z == near(7.5));
}
