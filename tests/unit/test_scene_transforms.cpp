// The steps of a <transform>. Figures marked so were printed by Mitsuba 3.9.1 for the same text.
#include "test_scene_tools.h"

#include <glm/geometric.hpp>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

/// Rows of the upper 3x4 part, read back from two disks, of which one is turned before the steps so
/// that its edges carry the y and z columns.
glm::dmat4 matrix_of(const std::string& steps) {
    const auto disk_of = [](const std::string& transform) {
        const Scene scene = load_body("<shape type=\"disk\"><transform name=\"to_world\">" +
                                      transform + "</transform></shape>");
        return std::get<Disk>(scene.shapes.at(0).geometry);
    };
    const Disk plain = disk_of(steps);
    const Disk turned = disk_of("<matrix value=\"0 0 1 1 0 0 0 1 0\"/>" + steps);
    CHECK(plain.edge_v == turned.edge_u);
    return {glm::dvec4(plain.edge_u, 0), glm::dvec4(plain.edge_v, 0), glm::dvec4(turned.edge_v, 0),
            glm::dvec4(plain.center, 1)};
}

void check_matrix(const std::string& steps, const glm::dmat4& rows, double tolerance) {
    INFO(steps);
    const glm::dmat4 matrix = matrix_of(steps);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            CHECK(matrix[column][row] == Approx(rows[row][column]).margin(tolerance).epsilon(0));
}

} // namespace

TEST_CASE("scene transforms: one step of each kind") {
    check_matrix("<translate x=\"1\" z=\"-2\"/>", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, -2, 0, 0, 0, 1},
                 0);
    check_matrix("<translate value=\"1, 2 3\"/>", {1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1},
                 0);
    check_matrix("<translate value=\"4\"/>", {1, 0, 0, 4, 0, 1, 0, 4, 0, 0, 1, 4, 0, 0, 0, 1}, 0);
    check_matrix("<scale x=\"2\"/>", {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 0);
    check_matrix("<scale value=\"2 3 4\"/>", {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1}, 0);
    check_matrix("<scale value=\".5\"/>", {.5, 0, 0, 0, 0, .5, 0, 0, 0, 0, .5, 0, 0, 0, 0, 1}, 0);
    check_matrix("<matrix value=\"1 2 3 4 5 6 7 8 10\"/>",
                 {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 0, 0, 0, 1}, 0);
    check_matrix("<matrix value=\"1 2 3 4, 5 6 7 8, 9 10 12 13, 0 0 0 1\"/>",
                 {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13, 0, 0, 0, 1}, 0);
}

TEST_CASE("scene transforms: rotations, quarter turns exactly") {
    check_matrix("<rotate z=\"1\" angle=\"90\"/>",
                 {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 0);
    check_matrix("<rotate x=\"1\" angle=\"-90\"/>",
                 {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}, 0);
    check_matrix("<rotate y=\"1\" angle=\"180\"/>",
                 {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}, 0);
    check_matrix("<rotate y=\"1\" angle=\"630\"/>",
                 {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}, 0);
    check_matrix("<rotate value=\"0 0 1\" angle=\"30\"/>",
                 {std::sqrt(.75), -.5, 0, 0, .5, std::sqrt(.75), 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                 1e-15);
    // Rodrigues' formula about (1, 1, 1)/sqrt(3) by 120 degrees permutes the axes.
    check_matrix("<rotate value=\"1\" angle=\"120\"/>",
                 {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}, 1e-15);
}

TEST_CASE("scene transforms: an axis that is no unit vector is a direction, and said to be") {
    const Scene scene = load_body("<shape type=\"disk\"><transform name=\"to_world\">\n"
                                  "<rotate y=\"2\" angle=\"90\"/></transform></shape>");
    CHECK(std::get<Disk>(scene.shapes[0].geometry).edge_u == glm::dvec3(0, 0, -1));
    REQUIRE(scene.notes.size() == 1);
    CHECK_THAT(scene.notes[0], Contains("scene.xml:3") && Contains("unit vector"));
}

TEST_CASE("scene transforms: steps act in the order they are written") {
    check_matrix("<translate x=\"1\"/><scale value=\"2\"/>",
                 {2, 0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}, 0); // Mitsuba
    check_matrix("<rotate z=\"1\" angle=\"90\"/><translate value=\"1 2 3\"/>",
                 {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1}, 0); // Mitsuba
}

TEST_CASE("scene transforms: lookat as in Mitsuba") {
    check_matrix("<lookat origin=\"1 2 3\" target=\"4 5 7\" up=\"0 1 0\"/>",
                 {0.8, -0.3086974620819092, 0.5144957304000854, 1, 0, 0.8574929237365723,
                  0.5144957304000854, 2, -0.6, -0.4115965962409973, 0.6859943270683289, 3, 0, 0, 0,
                  1},
                 1e-7);
    check_matrix("<lookat origin=\"1 2 3\" target=\"4 5 7\"/>",
                 {0.15700283646583557, 0.8429971933364868, 0.5144957304000854, 1,
                  -0.8429971933364868, -0.15700283646583557, 0.5144957304000854, 2,
                  0.5144957304000854, -0.5144957304000854, 0.6859943270683289, 3, 0, 0, 0, 1},
                 1e-7);
    check_matrix("<lookat origin=\"1 2 3\" target=\"4 5 7\" up=\"0 0 2\"/>",
                 {-0.7071067690849304, -0.48507124185562134, 0.5144957304000854, 1,
                  0.7071067690849304, -0.48507124185562134, 0.5144957304000854, 2, 0,
                  0.7276068925857544, 0.6859943270683289, 3, 0, 0, 0, 1},
                 1e-7);
}

TEST_CASE("scene transforms: a last row that is rounding is that of an affine matrix") {
    const std::string rows = "1 0 0 4 0 2 0 5 0 0 1e-6 6 ";
    const auto refusal = [&](const std::string& last) {
        return refusal_of_body(
            "<shape type=\"disk\"><transform name=\"to_world\"><matrix value=\"" + rows + last +
            "\"/></transform></shape>");
    };
    check_matrix("<matrix value=\"" + rows + "1e-17 0 0 1.0000000000000002\"/>",
                 {1, 0, 0, 4, 0, 2, 0, 5, 0, 0, 1e-6, 6, 0, 0, 0, 1}, 0.0);
    CHECK(refusal("9e-7 1.9e-6 9e-13 1.0000009").empty());
    // Each column has a size of its own.
    for (const char* last : {"1.1e-6 0 0 1", "0 2.1e-6 0 1", "0 0 1.1e-12 1", "0 0 0 1.0000011",
                             "0 0 0 0.9999989", "-1.1e-6 0 0 1", "0 0 0 -1", "0 0 0 0"})
        CHECK_THAT(refusal(last), Contains("last row"));
}

TEST_CASE("scene transforms: axes and directions of any length") {
    const std::string turn = " angle=\"90\"/>";
    for (const char* z : {"1e-320", "1e-200", "1e90"})
        check_matrix("<rotate z=\"" + std::string(z) + "\"" + turn,
                     {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 1e-15);
    for (const char* whole_turns : {"0", "360", "-720"}) // about nothing, as some exporters write
        check_matrix("<rotate x=\"0\" y=\"0\" z=\"0\" angle=\"" + std::string(whole_turns) + "\"/>",
                     {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 0);
    check_matrix("<lookat origin=\"0 0 0\" target=\"0 0 1e-200\" up=\"0 1e-300 0\"/>",
                 {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 1e-15);
}

TEST_CASE("scene transforms: refusals") {
    struct Case {
        std::string step, part;
    };
    const Case cases[] = {
        {"<rotate angle=\"30\"/>", "cannot be zero for an angle of 30"},
        {"<rotate x=\"1\"/>", "\"angle\""},
        {"<rotate x=\"1\" angle=\"a\"/>", "\"a\""},
        {"<lookat origin=\"1 2 3\" target=\"1 2 3\" up=\"0 1 0\"/>", "same point"},
        {"<lookat origin=\"0 0 0\" target=\"0 1 0\" up=\"0 2 0\"/>", "parallel"},
        {"<lookat origin=\"0 0 0\" up=\"0 2 0\"/>", "\"target\""},
        {"<lookat origin=\"0 0\" target=\"0 2 0\"/>", "three values"},
        {"<matrix value=\"1 2 3\"/>", "9 or 16"},
        {"<matrix value=\"1 2 3 4 5 6 7 8 nan\"/>", "\"nan\""},
        {"<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2\"/>", "last row"},
        {"<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 .1 1\"/>", "last row"},
        {"<scale value=\"1 2\"/>", "three values"},
        {"<scale value=\"1 2 3\" z=\"1\"/>", "not both"},
        {"<translate w=\"1\"/>", "\"w\""},
        {"<translate x=\"1\"><scale/></translate>", "cannot stand inside"},
        {"<float name=\"a\" value=\"1\"/>", "translate, rotate, scale"},
        {"<scale value=\"1e300\"/><scale value=\"1e300\"/>", "-1e+100 to 1e+100"},
        {"<scale x=\"0\"/>", "without inverse"},
    };
    for (const Case& c : cases) {
        INFO(c.step);
        CHECK_THAT(refusal_of_body("<shape type=\"disk\"><transform name=\"to_world\">" + c.step +
                                   "</transform></shape>"),
                   Contains("scene.xml:2") && Contains(c.part));
    }
}
