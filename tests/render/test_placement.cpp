// Where a scene is and how large: the same bits of a scene scaled by a power of two or moved,
// lengths and places aside. Other sizes and turns: row `scale_and_turn` of the catalogue.
#include "tests/support/placed_scene.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>

using namespace parhelion;
using namespace parhelion::test;

namespace {

Scene small_scene() {
    Scene scene = movable_scene();
    scene.integrator.aovs = {{"nn", "sh_normal", {}}, {"dd", "depth", {}}, {"pp", "position", {}}};
    return scene;
}

Image image_of(const Scene& scene) {
    RenderResult result = render_quietly(scene);
    CHECK(result.report.non_finite_samples == 0);
    return result.image;
}

bool same_bits(float a, float b) {
    return std::bit_cast<unsigned>(a) == std::bit_cast<unsigned>(b);
}

/// What a value of the reference is in the image of a placed scene.
float expected(const std::string& channel, float value, double share, const Placement& t) {
    if (channel == "dd.T") return static_cast<float>(value * t.scale);
    std::size_t axis = std::string("XYZ").find(channel.back());
    if (!channel.starts_with("pp.")) return value;
    return static_cast<float>(value * t.scale + share * t.move[static_cast<int>(axis)]);
}

/// Values of the placed scene that are not what the reference says. `hits`: as coverage().
int wrong_values(const Image& reference, const Image& image, const std::vector<float>& hits,
                 const Placement& t) {
    REQUIRE(reference.channels.size() == image.channels.size());
    int wrong = 0;
    for (std::size_t c = 0; c < image.channels.size(); c++) {
        const std::string& name = image.channels[c].name;
        bool rounded = name.starts_with("pp.") && t.move != glm::dvec3(0.0);
        for (std::size_t i = 0; i < image.pixel_count(); i++) {
            float value = image.channels[c].values[i];
            float truth = expected(name, reference.channels[c].values[i], hits[i], t);
            // A place and its move are rounded one after the other.
            float near = rounded ? 2e-7f * (std::abs(truth) + 8) : 0.f;
            wrong += rounded ? !(std::abs(value - truth) <= near) : !same_bits(value, truth);
        }
    }
    return wrong;
}

/// Of each pixel what is covered by surfaces.
std::vector<float> coverage(Scene scene) {
    scene.integrator.kind = IntegratorKind::depth; // its alpha does not count the sky
    return find_channel(image_of(scene), "A")->values;
}

void check_bits(const Scene& scene) {
    Image reference = image_of(scene);
    std::vector<float> hits = coverage(scene);
    CHECK(std::count_if(hits.begin(), hits.end(), [](float h) { return h > 0 && h < 1; }) > 5);
    const Placement placements[] = {{0x1p-40},        {0x1p-7},
                                    {0x1p13},         {0x1p40},
                                    {1, {1, -2, 3}},  {1, {1e9, -1e9, 0.25}},
                                    {1, {0, 0, 1e6}}, {0x1p-10, {-123456, 65, 0x1p-20}}};
    for (const Placement& t : placements) {
        CAPTURE(t.scale, t.move.x, t.move.y, t.move.z);
        CHECK(wrong_values(reference, image_of(placed(scene, t)), hits, t) == 0);
    }
}

} // namespace

TEST_CASE("Placement: the same bits at powers of two and anywhere; depth and places follow") {
    check_bits(small_scene());
}

TEST_CASE("Placement: the depth integrator gives lengths of the scene, its second moment their "
          "squares") {
    Scene scene = small_scene();
    scene.integrator.kind = IntegratorKind::depth;
    Image reference = image_of(scene);
    for (double scale : {0x1p-20, 0x1p13}) {
        Image image = image_of(placed(scene, {scale}));
        int wrong = 0;
        for (const auto& [name, factor] :
             {std::pair{"R", scale}, std::pair{"second_moment.G", scale * scale}})
            for (std::size_t i = 0; i < image.pixel_count(); i++)
                wrong += !same_bits(find_channel(image, name)->values[i],
                                    find_channel(reference, name)->values[i] * float(factor));
        CHECK(wrong == 0);
    }
    // In front of the camera, at 4.5, the wall behind the shapes at -2.
    float farthest = *std::max_element(find_channel(reference, "R")->values.begin(),
                                       find_channel(reference, "R")->values.end());
    CHECK((farthest > 6.4f && farthest < 11));
}
