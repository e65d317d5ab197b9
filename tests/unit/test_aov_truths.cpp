// Every AOV by its closed form: given where a hit lies, the shape says its normals, texture
// coordinates, numbers and colours.
#include "tests/support/gallery.h"

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::test::gallery;

namespace {

void check_hit(const FirstHit& h, const std::vector<Exhibit>& shown) {
    INFO("pixel " << h.x << " " << h.y << " shape " << h.shape);
    REQUIRE(h.alpha == (h.hit ? 1 : 0));
    REQUIRE((h.shape > 0) == h.hit);
    if (!h.hit) {
        // Nothing of anything.
        CHECK(glm::length(h.p) + glm::length(h.ns) + glm::length(h.albedo) + glm::length(h.uv) ==
              0);
        CHECK(h.depth == 0);
        CHECK(h.primitive == 0);
        return;
    }
    REQUIRE(h.shape <= int(shown.size()));
    const Exhibit& e = shown[h.shape - 1];
    glm::dvec3 at = h.p - glm::dvec3(place_of(h.shape - 1), 0);
    e.check(h, glm::dvec3(glm::inverse(e.to_world) * glm::dvec4(at, 1)));
    check_near(h.albedo, e.albedo, 1e-7);
    CHECK(
        h.depth ==
        Approx(glm::length(h.p - glm::dvec3(0, 0, 10)) * (1 - 0.01 / (10 - h.p.z))).epsilon(1e-5));
}

} // namespace

TEST_CASE("AOV truths: every value of every kind of shape follows from where it is hit",
          "[truths]") {
    std::vector<Exhibit> shown = exhibits();
    Scene scene = exhibition(shown);
    std::vector<int> seen(shown.size() + 1);
    for (int seed = 0; seed < 3; seed++) {
        scene.sampler.seed = seed;
        for (const FirstHit& h : first_hits(scene)) {
            check_hit(h, shown);
            seen[h.shape]++;
        }
    }
    for (int count : seen)
        CHECK(count > 100);
}

TEST_CASE("AOV truths: the numbers of a shape's triangles count from 0, all of them", "[truths]") {
    std::vector<Exhibit> shown = {mesh(true), mesh(false), cube()};
    std::vector<std::vector<int>> seen(4, std::vector<int>(12));
    for (const FirstHit& h : first_hits(exhibition(shown)))
        seen[h.shape][h.primitive]++;
    for (int mesh : {1, 2})
        for (int k = 0; k < 12; k++)
            CHECK((seen[mesh][k] > 0) == (k < 3));
    // Both halves of each face that is seen, and no other face.
    int halves = 0, faces = 0;
    for (int k = 0; k < 12; k += 2)
        halves += (seen[3][k] > 0) + (seen[3][k + 1] > 0), faces += seen[3][k] > 0;
    CHECK(faces == 3);
    CHECK(halves == 6);
}

TEST_CASE("AOV truths: the colour is that of the side that is seen", "[truths]") {
    std::string sides =
        "<bsdf type=\"twosided\">" + grey(0.1, 0.2, 0.3) + grey(0.6, 0.7, 0.8) + "</bsdf></shape>";
    std::string camera = looking_down(5, "<float name=\"fov\" value=\"20\"/>",
                                      "<integer name=\"width\" value=\"4\"/><integer "
                                      "name=\"height\" value=\"4\"/><rfilter type=\"box\"/>");
    for (bool back : {false, true}) {
        std::string turn = back ? "<transform name=\"to_world\"><rotate y=\"1\" "
                                  "angle=\"180\"/><scale value=\"9\"/></transform>"
                                : "<transform name=\"to_world\"><scale value=\"9\"/></transform>";
        Scene scene =
            scene_of_text(every_aov + "<shape type=\"rectangle\">" + turn + sides + camera);
        for (const FirstHit& h : first_hits(scene)) {
            check_near(h.albedo, back ? glm::dvec3(0.6, 0.7, 0.8) : glm::dvec3(0.1, 0.2, 0.3),
                       1e-7);
            check_near(h.ng, {0, 0, back ? -1 : 1}, 1e-6);
        }
    }
}

TEST_CASE("AOV truths: views show normals, from 0 to 1 for -1 to 1, and depths", "[truths]") {
    Scene scene = exhibition(exhibits());
    std::vector<FirstHit> hits = first_hits(scene);
    scene.integrator.aovs.clear();
    scene.integrator.kind = IntegratorKind::normals;
    Image normals = host_image(scene);
    scene.integrator.kind = IntegratorKind::depth;
    Image depths = host_image(scene);
    REQUIRE(hits.size() == normals.pixel_count());
    for (std::size_t i = 0; i < hits.size(); i++) {
        const FirstHit& h = hits[i];
        INFO("pixel " << h.x << " " << h.y << " shape " << h.shape);
        glm::dvec3 shown = h.hit ? 0.5 * (h.ns + 1.0) : glm::dvec3(0);
        check_near(
            {value_at(normals, "R", i), value_at(normals, "G", i), value_at(normals, "B", i)},
            shown, 1e-6);
        for (const char* channel : {"R", "G", "B"})
            REQUIRE(value_at(depths, channel, i) == Approx(h.depth).epsilon(1e-6));
    }
}
