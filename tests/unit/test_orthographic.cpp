// Orthographic cameras: rays by Mitsuba's figures, and pictures by closed forms.
#include "host/flatten/camera_record.h"
#include "tests/support/first_hits.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;

namespace {

std::string sensor(const std::string& to_world, const std::string& more, int width, int height,
                   int samples = 1) {
    return fmt::format("<sensor type=\"orthographic\"><transform name=\"to_world\">{}</transform>{}"
                       "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"{}\"/>"
                       "</sampler><film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/>"
                       "<integer name=\"height\" value=\"{}\"/><string name=\"pixel_format\" "
                       "value=\"rgba\"/><rfilter type=\"box\"/></film></sensor>\n",
                       to_world, more, samples, width, height);
}

std::string planes(double near, double far) {
    return fmt::format("<float name=\"near_clip\" value=\"{}\"/><float name=\"far_clip\" "
                       "value=\"{}\"/>",
                       near, far);
}

struct Ray {
    glm::dvec3 origin, direction;
    double length;
};

/// Of the point (x, y) of a film of 8 x 4 pixels, in widths and heights, world units.
Ray ray_at(const Scene& scene, const SceneFrame& frame, double x, double y) {
    const CameraRecord c = camera_record(scene.camera, 8, 4, frame);
    const double u = 8 * x, v = 4 * y;
    const glm::dvec3 d(c.dx, c.dy, c.dz);
    const glm::dvec3 o = glm::dvec3(c.ox, c.oy, c.oz) + u * glm::dvec3(c.ux, c.uy, c.uz) +
                         v * glm::dvec3(c.vx, c.vy, c.vz) + d * double(c.near_clip);
    return {o / frame.scale + frame.centre(), d, (c.far_clip - c.near_clip) / frame.scale};
}

void check_ray(const Ray& found, const Ray& expected) {
    check_near(found.origin, expected.origin, 6e-5); // as many digits as there are
    check_near(found.direction, expected.direction, 2e-6);
    CHECK(found.length == Approx(expected.length).epsilon(1e-5));
}

} // namespace

// By sample_ray of Mitsuba 3.9.1's orthographic plugin.
TEST_CASE("Orthographic: rays are Mitsuba's", "[camera]") {
    const auto scene_of = [](const std::string& to_world, const std::string& more) {
        return scene_of_text(sensor(to_world, more, 8, 4));
    };
    const SceneFrame world; // of no shapes: the camera at the world's origin
    const Scene plain = scene_of("", "");
    check_ray(ray_at(plain, world, 0, 0), {{1, 0.5, 0.01}, {0, 0, 1}, 9999.99});
    check_ray(ray_at(plain, world, 0.25, 0.75), {{0.5, -0.25, 0.01}, {0, 0, 1}, 9999.99});
    const Scene scaled = scene_of("<scale x=\"3\" y=\"5\" z=\"7\"/>", "");
    check_ray(ray_at(scaled, world, 1, 1), {{-3, -2.5, 0.07}, {0, 0, 1}, 9999.99});
    const Scene mirrored = scene_of("<scale x=\"-1\"/>", planes(2, 1e4));
    check_ray(ray_at(mirrored, world, 0, 0), {{-1, 0.5, 2}, {0, 0, 1}, 9998});
    const Scene sheared =
        scene_of("<matrix value=\"1 0 .5 0 0 1 0 0 0 0 1 0 0 0 0 1\"/>", planes(2, 1e4));
    check_ray(ray_at(sheared, world, 0, 0), {{2, 0.5, 2}, {0.447214, 0, 0.894427}, 9998});
    check_ray(ray_at(sheared, world, 0.25, 0.75), {{1.5, -0.25, 2}, {0.447214, 0, 0.894427}, 9998});
    const Scene turned =
        scene_of("<scale x=\"3\" y=\"5\" z=\"7\"/><lookat origin=\"1,2,3\" target=\"4,5,7\" "
                 "up=\"0,1,0\"/>",
                 planes(2, 20));
    SceneFrame frame;
    frame.camera = {1, 2, 3};
    check_ray(ray_at(turned, frame, 0, 0),
              {{9.8312, 11.3467, 9.77493}, {0.514496, 0.514496, 0.685994}, 18});
    check_ray(ray_at(turned, frame, 0.25, 0.75),
              {{9.78881, 8.13107, 12.2184}, {0.514496, 0.514496, 0.685994}, 18});
}

TEST_CASE("Orthographic: a disk covers its own area of the film", "[camera]") {
    // Radius 0.7 before a film of 3 x 2 units: pi 0.49 / 6 of it, wherever it stands.
    for (const double z : {0.0, -50.0}) {
        const Scene scene = scene_of_text(
            "<integrator type=\"path\"/>" +
            sensor("<scale x=\"1.5\" y=\"1.5\"/><lookat origin=\"0,0,4\" target=\"0,0,0\" "
                   "up=\"0,1,0\"/>",
                   "", 60, 40, 64) +
            fmt::format("<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"0.7\"/>"
                        "<translate x=\"0.3\" y=\"-0.2\" z=\"{}\"/></transform></shape>",
                        z));
        const Image image = host_image(scene);
        double covered = 0, x = 0, y = 0;
        for (int row = 0; row < 40; row++)
            for (int column = 0; column < 60; column++) {
                const double share = value_at(image, "A", image.index(column, row));
                covered += share;
                x += share * (column + 0.5), y += share * (row + 0.5);
            }
        CHECK(covered / 2400 == Approx(std::acos(-1.0) * 0.49 / 6).epsilon(2e-3));
        // 20 pixels a unit; image x to the world's +x, y to its -y.
        CHECK(x / covered == Approx(30 + 6).epsilon(2e-3));
        CHECK(y / covered == Approx(20 + 4).epsilon(2e-3));
    }
}

TEST_CASE("Orthographic: depth, position and the near plane, from near and from very far",
          "[camera]") {
    // A plane that leans by 0.25 in x, a unit high at x = 0; rays go along -z.
    const std::string plane = "<shape type=\"rectangle\"><transform name=\"to_world\"><matrix "
                              "value=\"2 0 0 0 0 2 0 0 0.5 0 1 1 0 0 0 1\"/></transform></shape>";
    for (const double distance : {4.0, 1e3, 1e7}) {
        INFO("from " << distance);
        const Scene scene = scene_of_text(
            every_aov + plane +
            sensor(
                fmt::format("<lookat origin=\"0,0,{0}\" target=\"0,0,0\" up=\"0,1,0\"/>", distance),
                planes(1.5, 2 * distance), 16, 16));
        for (const FirstHit& h : first_hits(scene)) {
            REQUIRE(h.hit);
            // Within its pixel, an eighth of a unit wide.
            CHECK(std::fabs(h.p.x - (-1 + (h.x + 0.5) / 8)) <= 0.0626);
            CHECK(std::fabs(h.p.y - (1 - (h.y + 0.5) / 8)) <= 0.0626);
            CHECK(h.p.z == Approx(1 + 0.25 * h.p.x).margin(2e-6));
            CHECK(h.depth == Approx(distance - 1.5 - h.p.z).epsilon(1e-6));
        }
    }
}

TEST_CASE("Orthographic: both planes cut", "[camera]") {
    const std::string walls = "<shape type=\"rectangle\"/><shape type=\"rectangle\"><transform "
                              "name=\"to_world\"><translate z=\"1\"/></transform></shape>";
    const auto shape_seen = [&](double near, double far) {
        const Scene scene =
            scene_of_text(every_aov + walls +
                          sensor("<lookat origin=\"0,0,4\" target=\"0,0,0\" up=\"0,1,0\"/>",
                                 planes(near, far), 1, 1));
        const FirstHit hit = first_hits(scene).at(0);
        return hit.hit ? hit.shape : -1;
    };
    CHECK(shape_seen(2.9, 10) == 2);
    CHECK(shape_seen(3.1, 10) == 1);
    CHECK(shape_seen(4.1, 10) == -1);
    CHECK(shape_seen(1, 2.9) == -1);
}

TEST_CASE("Orthographic: what it has no use for is refused", "[camera]") {
    using Catch::Matchers::Contains;
    const auto refused = [](const std::string& parameter) {
        return refusal_of_text("<scene version=\"3.0.0\">" + sensor("", parameter, 8, 4) +
                               "</scene>");
    };
    CHECK_THAT(refused("<float name=\"fov\" value=\"30\"/>"), Contains("no parameter \"fov\""));
    CHECK_THAT(refused("<float name=\"aperture_radius\" value=\"1\"/>"), Contains("no parameter"));
    CHECK(refused("<float name=\"focus_distance\" value=\"2\"/>").empty());
    CHECK_THAT(refusal_of_text("<scene version=\"3.0.0\">" + sensor("<scale z=\"0\"/>", "", 8, 4) +
                               "</scene>"),
               Contains("without inverse"));
}
