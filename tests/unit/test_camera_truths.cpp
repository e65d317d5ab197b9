// Every parameter of cameras and films by its closed form: where a sample's first hit lies says
// through which point of the film the ray went.
#include "tests/support/first_hits.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

using namespace parhelion;
using namespace parhelion::test;

namespace {

const std::string wall = "<shape type=\"rectangle\"><transform name=\"to_world\">"
                         "<scale value=\"100\"/></transform></shape>\n";

std::string film_of(int width, int height, const std::string& more = "") {
    return fmt::format("<integer name=\"width\" value=\"{}\"/><integer name=\"height\" "
                       "value=\"{}\"/>{}",
                       width, height,
                       more.find("rfilter") == std::string::npos ? more + "<rfilter type=\"box\"/>"
                                                                 : more);
}

/// A camera at `origin` with the directions of its image, and tan(half angle) across the film.
struct Pinhole {
    glm::dvec3 origin, right, down, forward;
    double half_tangent;
    int width, height;
    glm::dvec2 offset{0, 0}; ///< principal point, in widths and heights
};

/// Film position, pixels, of a point in the world.
glm::dvec2 film_position(const Pinhole& c, const glm::dvec3& p) {
    glm::dvec3 d = p - c.origin;
    double pixels = 0.5 * c.width / c.half_tangent / glm::dot(d, c.forward);
    return {(0.5 - c.offset.x) * c.width + pixels * glm::dot(d, c.right),
            (0.5 - c.offset.y) * c.height + pixels * glm::dot(d, c.down)};
}

Pinhole straight(double distance, double half_tangent, int width, int height) {
    return {{0, 0, distance}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}, half_tangent, width, height};
}

/// Every hit lies within its own pixel, and hits are spread over pixels.
void check_in_pixels(const std::vector<FirstHit>& hits, const Pinhole& camera) {
    glm::dvec2 low(1), high(0), sum(0);
    int outside = 0;
    for (const FirstHit& h : hits) {
        REQUIRE(h.hit);
        glm::dvec2 within = film_position(camera, h.p) - glm::dvec2(h.x, h.y);
        constexpr double rounding = 2e-4;
        outside += within.x < -rounding || within.x > 1 + rounding || within.y < -rounding ||
                   within.y > 1 + rounding;
        low = glm::min(low, within), high = glm::max(high, within);
        sum += within / double(hits.size());
    }
    CHECK(outside == 0);
    for (int axis = 0; axis < 2; axis++) {
        CHECK(low[axis] < 0.05);
        CHECK(high[axis] > 0.95);
        CHECK(sum[axis] == Approx(0.5).margin(4 * 0.289 / std::sqrt(double(hits.size()))));
    }
}

std::string fov(double degrees, const std::string& axis) {
    return fmt::format("<float name=\"fov\" value=\"{}\"/><string name=\"fov_axis\" value=\"{}\"/>",
                       degrees, axis);
}

} // namespace

TEST_CASE("Camera truths: the field of view along every axis, wide and tall", "[truths]") {
    const double half = std::tan(glm::radians(25.0));
    for (auto [width, height] : {std::pair{44, 24}, {24, 44}, {30, 30}}) {
        double w = width, h = height;
        const std::pair<const char*, double> axes[] = {
            {"x", half},
            {"y", half * w / h},
            {"diagonal", half * w / std::sqrt(w * w + h * h)},
            {"smaller", half * w / std::min(w, h)},
            {"larger", half * w / std::max(w, h)}};
        for (const auto& [axis, half_tangent] : axes) {
            INFO(axis << " of " << width << " x " << height);
            std::string text =
                every_aov + wall + looking_down(5, fov(50, axis), film_of(width, height));
            check_in_pixels(first_hits(scene_of_text(text)),
                            straight(5, half_tangent, width, height));
        }
    }
}

TEST_CASE("Camera truths: focal lengths are those of a film with a diagonal of 43.27 mm",
          "[truths]") {
    for (auto [width, height] : {std::pair{40, 22}, {22, 40}}) {
        double diagonal = std::hypot(width, height);
        double half_tangent = std::hypot(36.0, 24.0) / 2 / 35 * width / diagonal;
        std::string sensor = "<string name=\"focal_length\" value=\"35mm\"/>";
        std::string text = every_aov + wall + looking_down(5, sensor, film_of(width, height));
        check_in_pixels(first_hits(scene_of_text(text)), straight(5, half_tangent, width, height));
    }
}

TEST_CASE("Camera truths: the principal point moves by fractions of the film", "[truths]") {
    for (auto [x, y] : {std::pair{0.2, 0.0}, {0.0, -0.3}, {-0.1, 0.15}}) {
        Pinhole camera = straight(5, std::tan(glm::radians(20.0)), 40, 24);
        camera.offset = {x, y};
        std::string sensor =
            fov(40, "x") + fmt::format("<float name=\"principal_point_offset_x\" value=\"{}\"/>"
                                       "<float name=\"principal_point_offset_y\" value=\"{}\"/>",
                                       x, y);
        check_in_pixels(
            first_hits(scene_of_text(every_aov + wall + looking_down(5, sensor, film_of(40, 24)))),
            camera);
    }
}

TEST_CASE("Camera truths: a camera anywhere, turned and tilted", "[truths]") {
    std::string text = every_aov + wall + looking_down(5, fov(40, "x"), film_of(40, 24));
    std::string straight_on = "origin=\"0,0,5.000000\" target=\"0,0,0\" up=\"0,1,0\"";
    std::size_t at = text.find(straight_on);
    REQUIRE(at != std::string::npos);
    text.replace(at, straight_on.size(), "origin=\"1,2,6\" target=\"0.2,-0.3,0\" up=\"0.3,1,0\"");
    glm::dvec3 origin(1, 2, 6);
    glm::dvec3 forward = glm::normalize(glm::dvec3(0.2, -0.3, 0) - origin);
    glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.3, 1, 0)));
    glm::dvec3 down = glm::cross(forward, right);
    check_in_pixels(first_hits(scene_of_text(text)),
                    {origin, right, down, forward, std::tan(glm::radians(20.0)), 40, 24});
}

TEST_CASE("Camera truths: a crop has the pixels of the full film", "[truths]") {
    std::string crop = "<integer name=\"crop_offset_x\" value=\"7\"/>"
                       "<integer name=\"crop_offset_y\" value=\"3\"/>"
                       "<integer name=\"crop_width\" value=\"21\"/>"
                       "<integer name=\"crop_height\" value=\"18\"/>";
    Scene scene =
        scene_of_text(every_aov + wall + looking_down(5, fov(40, "x"), film_of(40, 24, crop)));
    Image image = host_image(scene);
    CHECK(std::array{image.full_width, image.full_height, image.offset_x, image.offset_y,
                     image.width, image.height} == std::array{40, 24, 7, 3, 21, 18});
    std::vector<FirstHit> hits = first_hits(scene);
    CHECK(hits.size() == 21 * 18);
    CHECK(hits.front().x == 7);
    CHECK(hits.front().y == 3);
    check_in_pixels(hits, straight(5, std::tan(glm::radians(20.0)), 40, 24));
}

TEST_CASE("Camera truths: near and far planes cut, and depth counts from the near one",
          "[truths]") {
    std::string near_wall = "<shape type=\"rectangle\"><transform name=\"to_world\"><scale "
                            "value=\"100\"/><translate z=\"3\"/></transform></shape>\n";
    // Walls 2 and 5 before the camera; which of them is seen.
    struct Clip {
        double near, far;
        int shape;
    };
    for (Clip clip : {Clip{0.01, 100, 2},
                      {1.99, 2.01, 2},
                      {1.5, 1.99, 0},
                      {2.01, 4.99, 0},
                      {2.01, 5.01, 1},
                      {4.9, 1e4, 1},
                      {5.01, 1e4, 0}}) {
        INFO("near " << clip.near << " far " << clip.far);
        std::string planes = fmt::format(
            "<float name=\"near_clip\" value=\"{}\"/><float name=\"far_clip\" value=\"{}\"/>",
            clip.near, clip.far);
        for (const FirstHit& h :
             first_hits(scene_of_text(every_aov + wall + near_wall +
                                      looking_down(5, fov(60, "x") + planes, film_of(16, 12))))) {
            REQUIRE(h.shape == clip.shape);
            REQUIRE(h.alpha == (clip.shape ? 1 : 0));
            if (!h.hit) continue;
            double distance = glm::length(h.p - glm::dvec3(0, 0, 5));
            double from_near = distance * (1 - clip.near / (5 - h.p.z));
            REQUIRE(h.depth == Approx(from_near).epsilon(1e-5));
        }
    }
}

TEST_CASE("Camera truths: a thin lens is sharp at its focus and blurs by its radius elsewhere",
          "[truths]") {
    const double radius = 0.4, focus = 5, half = std::tan(glm::radians(20.0));
    for (double distance : {5.0, 8.0, 3.0}) {
        INFO("distance " << distance);
        std::string text =
            every_aov + wall +
            looking_down(distance,
                         fov(40, "x") + fmt::format("<float name=\"aperture_radius\" value=\"{}\"/>"
                                                    "<float name=\"focus_distance\" value=\"{}\"/>",
                                                    radius, focus),
                         film_of(40, 24));
        text.replace(text.find("perspective"), 11, "thinlens");
        std::vector<FirstHit> hits = first_hits(scene_of_text(text));
        Pinhole camera = straight(distance, half, 40, 24);
        if (distance == focus) {
            check_in_pixels(hits, camera);
            continue;
        }
        // A cone of the lens's radius at the camera and none at the focus.
        double reach = radius * std::abs(distance - focus) / focus;
        double pixel = 2 * half * distance / 40;
        glm::dvec2 furthest(0);
        for (const FirstHit& h : hits) {
            glm::dvec2 off =
                (film_position(camera, h.p) - glm::dvec2(h.x + 0.5, h.y + 0.5)) * pixel;
            REQUIRE(glm::length(off) <= reach + 0.708 * pixel);
            furthest = glm::max(furthest, glm::abs(off));
        }
        CHECK(furthest.x > 0.85 * reach);
        CHECK(furthest.y > 0.85 * reach);
    }
}

TEST_CASE("Camera truths: samples that a wide filter places stay on the film, up to its edges",
          "[truths]") {
    std::string filter = "<rfilter type=\"tent\"><float name=\"radius\" value=\"2\"/></rfilter>";
    for (bool border : {false, true}) {
        INFO("sample_border " << border);
        std::string film = film_of(
            40, 24, fmt::format("<boolean name=\"sample_border\" value=\"{}\"/>", border) + filter);
        Scene scene = scene_of_text(every_aov + wall + looking_down(5, fov(40, "x"), film));
        scene.film.filter_method = FilterMethod::sampling;
        Pinhole camera = straight(5, std::tan(glm::radians(20.0)), 40, 24);
        glm::dvec2 low(1e9), high(-1e9), least(0), most(0);
        for (int seed = 0; seed < 8; seed++) {
            scene.sampler.seed = seed;
            for (const FirstHit& h : first_hits(scene)) {
                if (!h.hit) continue;
                glm::dvec2 at = film_position(camera, h.p);
                low = glm::min(low, at), high = glm::max(high, at);
                glm::dvec2 off = at - glm::dvec2(h.x + 0.5, h.y + 0.5);
                least = glm::min(least, off), most = glm::max(most, off);
            }
        }
        for (int axis = 0; axis < 2; axis++) {
            double side = axis ? 24 : 40;
            if (border) {
                CHECK(low[axis] < -0.5);
                CHECK(high[axis] > side + 0.5);
            } else {
                CHECK(low[axis] >= -1e-3);
                CHECK(low[axis] < 0.1);
                CHECK(high[axis] <= side + 1e-3);
                CHECK(high[axis] > side - 0.1);
            }
            CHECK(least[axis] >= -2.001);
            CHECK(least[axis] < -1.8);
            CHECK(most[axis] <= 2.001);
            CHECK(most[axis] > 1.8);
        }
    }
}
