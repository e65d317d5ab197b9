// The device's frame: scenes scaled by powers of two or moved are the same to the device, from the
// file on, and nothing leaves the range of single precision.
#include "host/numerics/every_kind_scene.h"
#include "tests/support/placed_scene.h"
#include "tests/unit/test_scene_tools.h"

#include <fmt/format.h>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

constexpr int largest_exponent = 40;

const glm::dvec3 moves[] = {{1, -2, 3},       {1e9, 0, 0},           {-1e9, 1e9, 1e9},
                            {0.125, 1024, 0}, {1e6, -123456.75, 77}, {-999999999.5, 5e8 + 0.25, 1}};

void check_placements(const Scene& scene) {
    std::string differs;
    for (int k = -largest_exponent; k <= largest_exponent; k++) {
        bool same = same_on_device(scene, placed(scene, {std::ldexp(1.0, k)}), differs);
        INFO("scale 2^" << k << " changes:" << differs);
        CHECK(same);
    }
    for (const glm::dvec3& move : moves) {
        bool same = same_on_device(scene, placed(scene, {1.0, move}), differs);
        INFO("moved by " << move.x << " " << move.y << " " << move.z << ", changes:" << differs);
        CHECK(same);
    }
}

/// Every loader and plugin that has a place, in files.
class WrittenScene {
public:
    Scene load(double scale, const glm::dvec3& move) const {
        LoadOptions options;
        auto point = [&](double x, double y, double z) {
            glm::dvec3 p = scale * glm::dvec3(x, y, z) + move;
            return fmt::format("{} {} {}", p.x, p.y, p.z);
        };
        options.parameters = {{"scale", fmt::format("{}", scale)},
                              {"move", fmt::format("{} {} {}", move.x, move.y, move.z)},
                              {"square", fmt::format("{}", scale * scale)},
                              {"eye", point(1, 2, 8)},
                              {"aim", point(0.5, 0.25, 0)},
                              {"point", point(2, 3, 1)},
                              {"near", fmt::format("{}", 0.5 * scale)},
                              {"far", fmt::format("{}", 100 * scale)},
                              {"lens", fmt::format("{}", 0.05 * scale)},
                              {"focus", fmt::format("{}", 7.3 * scale)}};
        return load_scene(file_, options);
    }

private:
    SceneFolder folder_;
    std::string obj_ = folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n"
                                              "f 1 2 3\nf 1 3 4\nf 2 3 5\nf 5 4 1\n");
    std::string ply_ = folder_.write(
        "b.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                 "property double z\nelement face 2\nproperty list uchar int vertex_indices\n"
                 "end_header\n-1 0 0\n-2 0.5 0\n-1 1 0.25\n-2 2 2\n3 0 1 2\n3 1 3 2\n");
    std::string file_ = folder_.write("scene.xml", R"(<scene version="3.0.0">
<integrator type="path"/>
<sensor type="thinlens">
  <transform name="to_world"><lookat origin="$eye" target="$aim" up="0 1 0"/></transform>
  <float name="near_clip" value="$near"/><float name="far_clip" value="$far"/>
  <float name="aperture_radius" value="$lens"/><float name="focus_distance" value="$focus"/>
</sensor>
<shape type="obj"><string name="filename" value="a.obj"/>
  <transform name="to_world"><rotate y="1" angle="90"/><scale value="$scale"/><translate value="$move"/></transform></shape>
<shape type="ply"><string name="filename" value="b.ply"/>
  <transform name="to_world"><scale value="$scale"/><translate value="$move"/></transform></shape>
<shape type="rectangle">
  <transform name="to_world"><translate y="3"/><rotate x="1" angle="90"/><scale value="$scale"/><translate value="$move"/></transform>
  <emitter type="area"><rgb name="radiance" value="3 2 1"/></emitter></shape>
<shape type="cube">
  <transform name="to_world"><scale x="2" y="0.5"/><translate z="-3"/><scale value="$scale"/><translate value="$move"/></transform></shape>
<shape type="sphere"><float name="radius" value="0.3"/><point name="center" x="1" y="2" z="-0.5"/>
  <transform name="to_world"><scale value="$scale"/><translate value="$move"/></transform>
  <emitter type="area"><rgb name="radiance" value="9 2 1"/></emitter></shape>
<shape type="disk">
  <transform name="to_world"><scale x="0.7" y="0.4"/><rotate x="1" angle="90"/><translate x="-2" y="2"/><scale value="$scale"/><translate value="$move"/></transform>
  <emitter type="area"><rgb name="radiance" value="3 7 1"/></emitter></shape>
<emitter type="point"><point name="position" value="$point"/>
  <spectrum name="intensity" value="$square"/></emitter>
<emitter type="spot"><spectrum name="intensity" value="$square"/>
  <transform name="to_world"><rotate x="1" angle="90"/><translate y="2"/><scale value="$scale"/><translate value="$move"/></transform></emitter>
<emitter type="directional"><vector name="direction" value="1 -2 0.5"/></emitter>
<emitter type="constant"/>
</scene>)");
};

} // namespace

TEST_CASE("Scene frame: every kind of shape, light and lens at any power of two and anywhere") {
    Scene scene = with_coarse_places(every_kind_scene());
    check_placements(placed(scene, {}));
    scene.integrator.hide_emitters = true; // a second tree, for the camera
    std::string differs;
    CHECK(same_on_device(scene, placed(scene, {0x1p13, {1e9, 0, 0}}), differs));
}

TEST_CASE("Scene frame: scaled and moved in the file") {
    WrittenScene written;
    Scene scene = written.load(1.0, {});
    std::string differs;
    for (int k = -largest_exponent; k <= largest_exponent; k++) {
        bool same = same_on_device(scene, written.load(std::ldexp(1.0, k), {}), differs);
        INFO("scale 2^" << k << " changes:" << differs);
        CHECK(same);
    }
    for (const glm::dvec3& move : moves) {
        bool same = same_on_device(scene, written.load(1.0, move), differs);
        INFO("moved by " << move.x << " " << move.y << " " << move.z << ", changes:" << differs);
        CHECK(same);
    }
}

TEST_CASE("Scene frame: vertices that are large in the file keep what doubles hold of them") {
    SceneFolder folder;
    auto load = [&](const std::string& name, const std::string& obj, double x) {
        folder.write(name + ".obj", obj);
        std::string text = fmt::format(R"(<scene version="3.0.0">
<sensor type="perspective"><transform name="to_world">
  <lookat origin="{0} 0 5" target="{0} 0 0" up="0 1 0"/></transform></sensor>
<shape type="obj"><string name="filename" value="{1}.obj"/></shape></scene>)",
                                       x, name);
        return load_scene(folder.write(name + ".xml", text));
    };
    Scene near = load("near", "v 0.25 0 0\nv 1.5 0 0\nv 0.25 1 -1\nf 1 2 3\n", 0);
    Scene far = load(
        "far", "v 1000000000.25 0 0\nv 1000000001.5 0 0\nv 1000000000.25 1 -1\nf 1 2 3\n", 1e9);
    std::string differs;
    bool same = same_on_device(near, far, differs);
    INFO(differs);
    CHECK(same);
}

namespace {

Scene scene_of(std::vector<Geometry> shapes, const glm::dvec3& camera) {
    Scene scene;
    scene.materials.push_back({"", {}, DiffuseBsdf{}});
    for (Geometry& g : shapes)
        scene.shapes.push_back(shape_of(std::move(g), 0, 0));
    scene.camera.to_world[3] = glm::dvec4(camera, 1);
    return scene;
}

Sphere ball(const glm::dvec3& centre, double radius) {
    Sphere s;
    s.center = centre, s.radius = radius;
    return s;
}

} // namespace

TEST_CASE(
    "Scene frame: what bounds the scene may be no sum that is exact, and zero may have a sign") {
    Scene scene = scene_of({ball({-0.0, 2, 3}, 0.1), ball({1, 0.5, -1}, 1.0 / 3)}, {0, 0.25, 9});
    for (const glm::dvec3& move : moves) {
        std::string differs;
        bool same = same_on_device(scene, placed(scene, {1.0, move}), differs);
        INFO("moved by " << move.x << " " << move.y << " " << move.z << ", changes:" << differs);
        CHECK(same);
    }
}

TEST_CASE("Scene frame: the centre is the point of the scene next to the camera, its unit a power "
          "of two") {
    SceneFrame outside = scene_frame(scene_of({ball({1, 2, 3}, 1)}, {1.5, 2, 9}));
    CHECK((outside.centre() == glm::dvec3(1.5, 2, 4)));
    CHECK(outside.scale == 512); // 2 wide
    CHECK(outside.unit_exponent() == -9);
    CHECK((outside.point({1.5, 3, 4}) == glm::dvec3(0, 512, 0)));
    SceneFrame inside = scene_frame(scene_of({ball({1, 2, 3}, 5)}, {1.5, 2, 4}));
    CHECK((inside.centre() == glm::dvec3(1.5, 2, 4)));
    CHECK(inside.scale == 128); // 10 wide
    Mesh unused = quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    unused.positions.push_back({1e30, 0, 0}); // of no triangle
    CHECK(scene_frame(scene_of({unused}, {})).scale == 1024);
}

TEST_CASE("Scene frame: rays of a camera far away begin a scene's size before the box's nearest "
          "corner") {
    for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1),
                                glm::dvec3(0.48, -0.6, 0.64), glm::dvec3(-0.6, 0.64, -0.48)})
        for (double distance : {60.0, 300.0, 1e6}) {
            CAPTURE(d.x, d.y, d.z, distance);
            Scene scene = scene_of({ball({1, 2, 3}, 0.5)}, glm::dvec3(1, 2, 3) - distance * d);
            scene.camera.to_world[2] = glm::dvec4(d, 0);
            double nearest = distance - 0.5 * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
            double expected = nearest > 64 ? nearest - 1 : 0;
            CHECK(scene_frame(scene).start == Approx(expected).epsilon(1e-12));
        }
}

TEST_CASE("Scene frame: a grain beside a planet keeps its shape") {
    Scene scene =
        scene_of({ball({0, -1e7, 0}, 1e7), ball({2e-6, 1e-6, 3e-6}, 1e-6)}, {1e-5, 4e-6, 2e-5});
    DeviceScene flat = make_device_scene(scene);
    PrimitiveRecord grain = flat.geometry.primitive(1);
    glm::dvec3 camera = flat.frame.point(glm::dvec3(scene.camera.to_world[3]));
    glm::dvec3 seen = (glm::dvec3(grain.ax, grain.ay, grain.az) - camera) * flat.frame.unit();
    glm::dvec3 truth(2e-6 - 1e-5, 1e-6 - 4e-6, 3e-6 - 2e-5);
    CHECK(glm::length(seen - truth) < 1e-7 * glm::length(truth));
    CHECK(grain.extra * flat.frame.unit() == Approx(1e-6).epsilon(1e-7));
}

TEST_CASE(
    "Scene frame: scenes without extent have their own unit, and any size is fine but one that "
    "is no number") {
    CHECK(scene_frame(scene_of({}, {1, 2, 3})).scale == 1);
    Mesh point;
    point.positions = {{4, 5, 6}};
    point.triangles = {{0, 0, 0}};
    CHECK(scene_frame(scene_of({point}, {1, 2, 3})).scale == 1);
    for (double size : {1e-320, 1e-300, 1e-30, 1e30, 1e300}) {
        DeviceScene flat = make_device_scene(scene_of({ball({size, 0, 0}, size)}, {}));
        INFO(size);
        PrimitiveRecord sphere = flat.geometry.primitive(0);
        CHECK(std::isfinite(sphere.extra));
        CHECK(sphere.extra > 0);
        CHECK(std::isfinite(sphere.ax));
    }
    Scene broken = scene_of({ball({-1.5e308, 0, 0}, 1), ball({1.5e308, 0, 0}, 1)}, {});
    broken.file = "far.xml";
    CHECK_THROWS_WITH(scene_frame(broken), Catch::StartsWith("far.xml: "));
    broken = scene_of({ball({1.5e308, 0, 0}, 1)}, {-1.5e308, 0, 0});
    CHECK_THROWS_AS(scene_frame(broken), InputError);
}
