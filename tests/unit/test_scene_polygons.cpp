// Faces cut into triangles: areas against the shoelace formula (Meister 1769), outlines against the
// edges of the triangles.
#include "host/scene/meshes/polygon.h"
#include "test_scene_tools.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <numbers>
#include <random>

using namespace parhelion;

namespace {

using Outline = std::vector<glm::dvec3>;

double shoelace(const Outline& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec3 &a = p[i], &b = p[(i + 1) % p.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum / 2.0;
}

Outline with_crossings(Outline p, const PolygonTriangles& cut) {
    for (const CrossingCorner& crossing : cut.crossings) {
        glm::dvec3 place(0.0);
        for (std::size_t k = 0; k < 4; ++k)
            place += crossing.weights[k] * p.at(crossing.corners[k]);
        p.push_back(place);
    }
    return p;
}

/// Without signs: parts that lie over each other, or outside, make it larger.
double covered(const Outline& outline, const PolygonTriangles& cut) {
    const Outline p = with_crossings(outline, cut);
    double sum = 0.0;
    for (const glm::uvec3& t : cut.triangles)
        sum += glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2.0;
    return sum;
}

/// Every side of the outline is one of one triangle, in its direction; every other side belongs to
/// two triangles, in both directions. So neighbours that share corners leave no gap.
bool closes(const Outline& outline, const PolygonTriangles& cut) {
    std::map<std::pair<unsigned, unsigned>, int> sides;
    const auto add = [&](unsigned a, unsigned b, int times) {
        sides[std::minmax(a, b)] += a < b ? times : -times;
    };
    for (const glm::uvec3& t : cut.triangles)
        for (int i = 0; i < 3; ++i)
            add(t[i], t[(i + 1) % 3], 1);
    for (unsigned i = 0; i < outline.size(); ++i)
        add(i, static_cast<unsigned>((i + 1) % outline.size()), -1);
    return std::all_of(sides.begin(), sides.end(), [](const auto& s) { return s.second == 0; });
}

Outline polar(int n, double turns, const std::function<double(int)>& radius) {
    Outline p;
    for (int i = 0; i < n; ++i) {
        const double angle = turns * 2.0 * std::numbers::pi * i / n;
        const double r = radius(i);
        p.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    return p;
}

Outline star(int n) {
    return polar(n, 1.0, [](int i) { return i % 2 ? 1.0 : 0.5; });
}

Outline comb(int n) {
    Outline p;
    for (int i = 0; i < n / 2; ++i)
        p.emplace_back(i, -1.0, 0.0);
    for (int i = n / 2 - 1; i >= 0; --i)
        p.emplace_back(i, i % 2 ? 1.0 : 0.125, 0.0);
    return p;
}

Outline coast(int n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> roughness(0.9, 1.1);
    return polar(n, 1.0, [&](int) { return roughness(random); });
}

/// A band wound n / 20000 times and once more.
Outline spiral(int n) {
    const double turns = 1.0 + std::floor(n / 20000.0);
    const auto at = [&](int i, double r) {
        const double angle = 2.0 * std::numbers::pi * turns * 2.0 * i / n;
        return glm::dvec3((r + angle) * std::cos(angle), (r + angle) * std::sin(angle), 0.0);
    };
    Outline p;
    for (int i = 0; i < n / 2; ++i)
        p.push_back(at(i, 3.0));
    for (int i = n / 2 - 1; i >= 0; --i)
        p.push_back(at(i, 1.0));
    return p;
}

const std::vector<std::pair<std::string, Outline>>& simple_outlines() {
    static const std::vector<std::pair<std::string, Outline>> outlines = {
        {"arrow", {{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 1.5, 0}}},
        {"L", {{0, 0, 0}, {1.5, 0, 0}, {1.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 2, 0}, {0, 2, 0}}},
        {"L with corners in its sides",
         {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 1, 0}, {0, 1, 0}}},
        {"tee",
         {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}, {2, 3, 0}, {1, 3, 0}, {1, 1, 0}, {0, 1, 0}}},
        {"star 10", star(10)},
        {"star 300", star(300)},
        {"star 2000", star(2000)},
        {"comb 300", comb(300)},
        {"coast 300", coast(300)},
        {"coast 5000", coast(5000)},
        {"spiral 300", spiral(300)},
        {"spiral 5000", spiral(5000)},
    };
    return outlines;
}

Outline turned(const Outline& p, std::size_t first) {
    Outline result(p.begin() + static_cast<std::ptrdiff_t>(first), p.end());
    result.insert(result.end(), p.begin(), p.begin() + static_cast<std::ptrdiff_t>(first));
    return result;
}

} // namespace

TEST_CASE("scene polygons: simple outlines are covered once, from any corner and either way") {
    for (const auto& [name, outline] : simple_outlines())
        for (std::size_t k = 0; k < 4; ++k)
            for (const bool reversed : {false, true}) {
                INFO(name << ", corner " << k << ", reversed " << reversed);
                Outline p = turned(outline, k * outline.size() / 4);
                if (reversed) std::reverse(p.begin(), p.end());
                const PolygonTriangles cut = triangulate(p);
                CHECK(cut.triangles.size() == p.size() - 2);
                CHECK(cut.crossings.empty());
                CHECK(covered(p, cut) == Approx(std::abs(shoelace(p))).epsilon(1e-12));
                CHECK(closes(p, cut));
            }
}

TEST_CASE("scene polygons: the plane, the place and the size of a face do not matter") {
    const glm::dmat4 tilt = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 3));
    for (const auto& [name, outline] : simple_outlines())
        for (const double size : {1e-150, 1e-3, 1.0, 1e20, 1e150}) {
            INFO(name << ", size " << size);
            Outline p;
            for (const glm::dvec3& corner : outline)
                p.push_back(size * glm::dvec3(tilt * glm::dvec4(corner + 1.0, 1.0)));
            const PolygonTriangles cut = triangulate(p);
            CHECK(cut.triangles.size() == p.size() - 2);
            CHECK(closes(p, cut));
            Outline unit = p;
            for (glm::dvec3& corner : unit)
                corner /= size;
            CHECK(covered(unit, cut) == Approx(std::abs(shoelace(outline))).epsilon(1e-9));
        }
}

TEST_CASE("scene polygons: a fan around the first corner where that covers the face") {
    const auto is_fan = [](const Outline& p) {
        const std::vector<glm::uvec3> triangles = triangulate(p).triangles;
        bool fan = triangles.size() == p.size() - 2;
        for (unsigned i = 0; fan && i < triangles.size(); ++i)
            fan = triangles[i] == glm::uvec3(0, i + 1, i + 2);
        return fan;
    };
    CHECK(is_fan({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    CHECK(is_fan({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    CHECK(is_fan({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.7}, {0, 1, 0}}));          // not flat
    CHECK(is_fan({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}})); // corner in a side
    CHECK_FALSE(is_fan({{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 2, 0}}));
    CHECK(is_fan({{0, 0, 0}, {1, -1, 0}, {0, 2, 0}, {-1, -1, 0}})); // hollow at the first
    CHECK(is_fan({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}));    // a corner twice
    CHECK(is_fan({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));    // no area
    CHECK(is_fan({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}}));
    const glm::dmat4 tilt = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 3));
    for (const int n : {5, 64, 300, 10000}) {
        Outline round = polar(n, 1.0, [](int) { return 1.0; });
        CHECK(is_fan(round));
        for (glm::dvec3& p : round)
            p = glm::dvec3(tilt * glm::dvec4(p + 100.0, 1.0));
        CHECK(is_fan(round));
    }
}

TEST_CASE("scene polygons: holes, and outlines that touch or cross themselves") {
    struct Case {
        std::string name;
        double area;
        std::size_t crossings;
        Outline outline;
    };
    const Case cases[] = {
        {"hole by repeated corners",
         15.0,
         0,
         {{0, 0, 0},
          {4, 0, 0},
          {4, 4, 0},
          {0, 4, 0},
          {0, 0, 0},
          {1, 1, 0},
          {1, 2, 0},
          {2, 2, 0},
          {2, 1, 0},
          {1, 1, 0}}},
        {"hole around the other way",
         15.0,
         0,
         {{0, 0, 0},
          {4, 0, 0},
          {4, 4, 0},
          {0, 4, 0},
          {0, 0, 0},
          {1, 1, 0},
          {2, 1, 0},
          {2, 2, 0},
          {1, 2, 0},
          {1, 1, 0}}},
        {"two holes",
         30.0,
         0,
         {{0, 0, 0},
          {8, 0, 0},
          {8, 4, 0},
          {0, 4, 0},
          {0, 0, 0},
          {1, 1, 0},
          {1, 2, 0},
          {2, 2, 0},
          {5, 2, 0},
          {6, 2, 0},
          {6, 1, 0},
          {5, 1, 0},
          {5, 2, 0},
          {2, 2, 0},
          {2, 1, 0},
          {1, 1, 0}}},
        {"a corner in a corner",
         8.0,
         0,
         {{0, 0, 0}, {2, 2, 0}, {4, 0, 0}, {4, 4, 0}, {2, 2, 0}, {0, 4, 0}}},
        {"a corner in a side", 8.0, 0, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}},
        {"a side there and back",
         4.0,
         0,
         {{0, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}},
        {"bow tie", 0.5, 1, {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}},
    };
    for (const Case& c : cases) {
        INFO(c.name);
        const PolygonTriangles cut = triangulate(c.outline);
        CHECK(covered(c.outline, cut) == Approx(c.area).epsilon(1e-12));
        CHECK(cut.crossings.size() == c.crossings);
    }
    // The points of a pentagram without its middle, of which each goes around once.
    const Outline pentagram = polar(5, 2.0, [](int) { return 1.0; });
    const PolygonTriangles cut = triangulate(pentagram);
    const double s = std::sqrt(5.0), side = 2.0 * std::sin(std::numbers::pi / 5.0);
    const double chord = side * (1.0 + s) / 2.0; // from point to point
    const double inner = chord * (s - 2.0);      // side of the pentagon in the middle
    const double tip = inner * (1.0 + s) / 2.0;  // equal sides of a point
    const double points = 5.0 * 0.5 * inner * std::sqrt(tip * tip - inner * inner / 4.0);
    CHECK(cut.crossings.size() == 5);
    CHECK(covered(pentagram, cut) == Approx(points).epsilon(1e-12));
}

TEST_CASE("scene polygons: faces that are not flat") {
    Outline p = star(300);
    for (std::size_t i = 0; i < p.size(); ++i)
        p[i].z = 0.1 * std::sin(0.3 * static_cast<double>(i));
    const PolygonTriangles cut = triangulate(p);
    CHECK(cut.triangles.size() == p.size() - 2);
    CHECK(closes(p, cut));
    for (glm::dvec3& corner : p)
        corner.z = 0.0; // seen from above, which the normal nearly is
    CHECK(covered(p, cut) == Approx(shoelace(p)).epsilon(1e-9));
}

TEST_CASE("scene polygons: a hundred thousand corners") {
    for (const auto& [name, p] : {std::pair<std::string, Outline>("star", star(100000)),
                                  {"comb", comb(100000)},
                                  {"coast", coast(100000)},
                                  {"spiral", spiral(100000)}}) {
        INFO(name);
        const auto start = std::chrono::steady_clock::now();
        const PolygonTriangles cut = triangulate(p);
        CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
        CHECK(cut.triangles.size() == p.size() - 2);
        CHECK(covered(p, cut) == Approx(std::abs(shoelace(p))).epsilon(1e-9));
        CHECK(closes(p, cut));
    }
}

TEST_CASE("scene polygons: outlines that cross themselves everywhere end, and say so") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    Outline p;
    for (int i = 0; i < 50000; ++i)
        p.emplace_back(coordinate(random), coordinate(random), 0.0);
    const auto start = std::chrono::steady_clock::now();
    CHECK(triangulate(p).tangled);
    p.resize(3000);
    CHECK(triangulate(p).tangled);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
}
