// Shapes whose first hits have closed forms, side by side before a camera.
#pragma once

#include "tests/support/first_hits.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <functional>

namespace parhelion::test::gallery {
inline constexpr double pi = 3.14159265358979323846, margin = 3e-5;

inline std::string grey(double r, double g, double b) {
    return fmt::format(
        "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"{} {} {}\"/></bsdf>", r, g, b);
}

/// A shape of its own colour, at `place` on top of its own transform.
struct Exhibit {
    std::string text;
    glm::dvec3 albedo;
    glm::dmat4 to_world;
    std::function<void(const FirstHit&, const glm::dvec3& local)> check;
};

inline std::string transform_text(const std::string& own, const glm::dvec2& place) {
    return fmt::format("<transform name=\"to_world\">{}<translate x=\"{}\" y=\"{}\"/></transform>",
                       own, place.x, place.y);
}

/// One shape alone in the middle, then all of them side by side: its numbers change, nothing else.
inline glm::dvec2 place_of(std::size_t i) {
    std::size_t column = i % 4, row = i / 4;
    return {-2.4 + 1.6 * double(column), 0.8 - 1.6 * double(row)};
}

inline double turns(double y, double x) {
    double phi = std::atan2(y, x) / (2 * pi);
    return phi < 0 ? phi + 1 : phi;
}

/// No jump where an angle goes once around.
inline void check_turns(double found, double expected) {
    double off = std::abs(found - expected);
    CHECK(std::min(off, 1 - off) < margin);
}

inline glm::dmat4 turned(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1), glm::radians(degrees), axis);
}

inline glm::dvec3 rotated(const glm::dmat4& m, const glm::dvec3& v) {
    return glm::normalize(glm::dvec3(m * glm::dvec4(v, 0)));
}

inline Exhibit rectangle() {
    glm::dmat4 m = turned(30, {0, 0, 1}) * glm::scale(glm::dmat4(1), glm::dvec3(0.7, 0.5, 1));
    return {"<shape type=\"rectangle\">{}" + grey(0.1, 0.2, 0.3) + "</shape>",
            {0.1, 0.2, 0.3},
            m,
            [](const FirstHit& h, const glm::dvec3& q) {
                CHECK(q.z == Approx(0).margin(margin));
                check_near(h.ng, {0, 0, 1}, margin);
                check_near(h.ns, h.ng, 0);
                CHECK(h.uv.x == Approx((q.x + 1) / 2).margin(margin));
                CHECK(h.uv.y == Approx((q.y + 1) / 2).margin(margin));
                CHECK((h.primitive == 0 || h.primitive == 1));
            }};
}

inline Exhibit disk(bool flipped) {
    glm::dmat4 m = turned(40, {0, 0, 1}) * glm::scale(glm::dmat4(1), glm::dvec3(0.7, 0.5, 1));
    if (flipped) m = m * turned(180, {0, 1, 0}); // so that its front is seen
    return {fmt::format("<shape type=\"disk\">{{}}<boolean name=\"flip_normals\" value=\"{}\"/>",
                        flipped) +
                grey(0.2, 0.3, flipped ? 0.9 : 0.4) + "</shape>",
            {0.2, 0.3, flipped ? 0.9 : 0.4},
            m,
            [](const FirstHit& h, const glm::dvec3& q) {
                check_near(h.ng, {0, 0, 1}, margin);
                check_near(h.ns, h.ng, 0);
                CHECK(q.z == Approx(0).margin(margin));
                CHECK(h.uv.x == Approx(std::hypot(q.x, q.y)).margin(margin));
                check_turns(h.uv.y, turns(q.y, q.x));
                CHECK(h.primitive == 0);
            }};
}

inline Exhibit sphere(bool flipped) {
    glm::dmat4 m = turned(70, {0.6, 0.8, 0}) * glm::scale(glm::dmat4(1), glm::dvec3(0.6));
    return {fmt::format("<shape type=\"sphere\">{{}}<boolean name=\"flip_normals\" value=\"{}\"/>",
                        flipped) +
                (flipped ? "<bsdf type=\"twosided\">" + grey(0.3, 0.4, 0.8) + "</bsdf>"
                         : grey(0.3, 0.4, 0.5)) +
                "</shape>",
            {0.3, 0.4, flipped ? 0.8 : 0.5},
            m,
            [m, flipped](const FirstHit& h, const glm::dvec3& q) {
                CHECK(glm::length(q) == Approx(1).margin(margin));
                check_near(h.ng, rotated(m, q) * (flipped ? -1.0 : 1.0), margin);
                check_near(h.ns, h.ng, 0);
                check_turns(h.uv.x, turns(q.y, q.x));
                CHECK(h.uv.y == Approx(std::acos(q.z / glm::length(q)) / pi).margin(margin));
                CHECK(h.primitive == 0);
            }};
}

/// uv of the faces as in Mitsuba 3 (tests/mitsuba/FACTS.md).
inline glm::dvec2 cube_uv(const glm::dvec3& q, const glm::dvec3& n) {
    glm::dvec2 uv(0);
    if (n.z > 0.5) uv = {q.y, q.x};
    if (n.z < -0.5) uv = {-q.y, q.x};
    if (n.x > 0.5) uv = {q.y, -q.z};
    if (n.x < -0.5) uv = {q.y, q.z};
    if (n.y > 0.5) uv = {-q.x, -q.z};
    if (n.y < -0.5) uv = {q.z, q.x};
    return (uv + 1.0) / 2.0;
}

inline Exhibit cube() {
    glm::dmat4 m =
        turned(35, {0, 1, 0}) * turned(20, {1, 0, 0}) * glm::scale(glm::dmat4(1), glm::dvec3(0.4));
    return {"<shape type=\"cube\">{}" + grey(0.4, 0.5, 0.6) + "</shape>",
            {0.4, 0.5, 0.6},
            m,
            [m](const FirstHit& h, const glm::dvec3& q) {
                glm::dvec3 a = glm::abs(q), face(0);
                int axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
                face[axis] = q[axis] > 0 ? 1 : -1;
                CHECK(a[axis] == Approx(1).margin(margin));
                check_near(h.ng, rotated(m, face), margin);
                glm::dvec2 uv = cube_uv(q, face);
                CHECK(h.uv.x == Approx(uv.x).margin(margin));
                CHECK(h.uv.y == Approx(uv.y).margin(margin));
                CHECK((h.primitive >= 0 && h.primitive < 12));
            }};
}

// Three triangles around the corner 0, in the plane z = 0.
inline const glm::dvec2 corners[] = {{0.1, -0.05}, {0.6, -0.5}, {0.1, 0.6}, {-0.6, -0.4}};
inline const int triangles[][3] = {{0, 1, 2}, {0, 2, 3}, {3, 1, 0}};

/// Barycentrics of the second and third corner.
inline glm::dvec2 barycentrics(const glm::dvec2& q, const int (&t)[3]) {
    glm::dvec2 a = corners[t[0]], e = corners[t[1]] - a, f = corners[t[2]] - a, d = q - a;
    double area = e.x * f.y - e.y * f.x;
    return {(d.x * f.y - d.y * f.x) / area, (e.x * d.y - e.y * d.x) / area};
}

inline glm::dvec2 corner_uv(int corner) {
    return {0.1 + 0.2 * corner, 0.9 - 0.25 * corner * corner / 9.0};
}
inline glm::dvec3 corner_normal(int corner) {
    return glm::normalize(glm::dvec3(0.3 * corners[corner].x, corners[corner].y, 1 + 0.1 * corner));
}

inline std::string mesh_file(bool attributes) {
    std::string obj;
    for (const glm::dvec2& p : corners)
        obj += fmt::format("v {} {} 0\n", p.x, p.y);
    for (int i = 0; i < 4 && attributes; i++) {
        glm::dvec3 n = corner_normal(i);
        obj +=
            fmt::format("vt {} {}\nvn {} {} {}\n", corner_uv(i).x, corner_uv(i).y, n.x, n.y, n.z);
    }
    for (const auto& t : triangles)
        obj += attributes ? fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", t[0] + 1,
                                        t[1] + 1, t[2] + 1)
                          : fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return obj;
}

/// `flip_tex_coords` off, so that v is the file's.
inline Exhibit mesh(bool attributes) {
    glm::dmat4 m = turned(15, {0, 0, 1});
    std::string name = attributes ? "full" : "bare";
    return {fmt::format("<shape type=\"obj\">{{}}<string name=\"filename\" value=\"{}.obj\"/>"
                        "<boolean name=\"flip_tex_coords\" value=\"false\"/>"
                        "<boolean name=\"face_normals\" value=\"{}\"/>",
                        name, !attributes) +
                grey(0.5, attributes, 0.7) + "</shape>",
            {0.5, attributes, 0.7},
            m,
            [m, attributes](const FirstHit& h, const glm::dvec3& q) {
                REQUIRE((h.primitive >= 0 && h.primitive < 3));
                const int(&t)[3] = triangles[h.primitive];
                glm::dvec2 b = barycentrics({q.x, q.y}, t);
                double b0 = 1 - b.x - b.y;
                CHECK(std::min({b.x, b.y, b0}) > -margin);
                glm::dvec2 uv = b;
                if (attributes)
                    uv = corner_uv(t[0]) * b0 + corner_uv(t[1]) * b.x + corner_uv(t[2]) * b.y;
                CHECK(h.uv.x == Approx(uv.x).margin(margin));
                CHECK(h.uv.y == Approx(uv.y).margin(margin));
                check_near(h.ng, {0, 0, 1}, margin);
                glm::dvec3 n = corner_normal(t[0]) * b0 + corner_normal(t[1]) * b.x +
                               corner_normal(t[2]) * b.y;
                check_near(h.ns, attributes ? rotated(m, n) : glm::dvec3(0, 0, 1), margin);
            }};
}

inline std::vector<Exhibit> exhibits() {
    return {rectangle(), disk(false),  sphere(false), cube(),
            mesh(false), sphere(true), disk(true),    mesh(true)};
}

inline std::string matrix_text(const glm::dmat4& m) {
    std::string text;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            text += fmt::format("{:.17g} ", m[column][row]);
    return "<matrix value=\"" + text + "\"/>";
}

inline Scene exhibition(const std::vector<Exhibit>& shown) {
    const SceneFolder folder;
    folder.write("full.obj", mesh_file(true));
    folder.write("bare.obj", mesh_file(false));
    std::string body = every_aov;
    for (std::size_t i = 0; i < shown.size(); i++)
        body += fmt::format(fmt::runtime(shown[i].text),
                            transform_text(matrix_text(shown[i].to_world), place_of(i)));
    body += looking_down(10, "<float name=\"fov\" value=\"38\"/>",
                         "<integer name=\"width\" value=\"72\"/><integer name=\"height\" "
                         "value=\"40\"/><rfilter type=\"box\"/>");
    Scene scene =
        load_scene(folder.write("scene.xml", "<scene version=\"3.0.0\">" + body + "</scene>"));
    apply_overrides({}, scene);
    return scene;
}

} // namespace parhelion::test::gallery
