// Skies of images: how files say them, what kernels need for them, what a surface under one gets.
#include "host/flatten/device_scene.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/sky_images.h"
#include "host/twin/device_functions.h"
#include "test_scene_tools.h"
#include "tests/support/example_sky.h"
#include "tests/support/image_files.h"
#include "tests/support/lit_square.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

std::string envmap(const std::string& inside = "", const std::string& file = "sky.pfm") {
    return fmt::format("<emitter type='envmap'>\n<string name='filename' value='{}'/>\n{}"
                       "</emitter>",
                       file, inside);
}

void write_images(const SceneFolder& folder) {
    folder.write("sky.pfm", pfm_of(3, 2, std::vector<float>(18, 0.5f), 3));
    std::vector<float> dark(18, 1.f);
    dark[4] = -0.25f;
    folder.write("negative.pfm", pfm_of(3, 2, dark, 3));
    dark[4] = NAN;
    folder.write("nan.pfm", pfm_of(3, 2, dark, 3));
}

Scene load_with_sky(const std::string& body) {
    SceneFolder folder;
    write_images(folder);
    return load_scene(folder.write("scene.xml", scene_text(body)));
}
EnvmapEmitter sky_in(const std::string& inside) {
    return std::get<EnvmapEmitter>(load_with_sky(envmap(inside)).emitters.at(0));
}
/// Of reading, or of what reading the texels shows.
std::string refusal_with_sky(const std::string& body) {
    SceneFolder folder;
    write_images(folder);
    std::string file = folder.write("scene.xml", scene_text(body));
    if (std::string refused = refusal_of(file); !refused.empty()) return refused;
    try {
        make_device_scene(load_scene(file));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// The integral over directions w above a surface facing +z of f(radiance, w.z), by the midpoint
/// rule.
template<class F>
double over_hemisphere(const SkyImage& image, const glm::dmat3& to_world, const F& f) {
    constexpr int around = 2048, up = 1024;
    double sum = 0;
    for (int j = 0; j < up; j++) {
        double z = (j + 0.5) / up, r = std::sqrt(1 - z * z);
        for (int i = 0; i < around; i++) {
            double phi = 2 * std::numbers::pi * (i + 0.5) / around;
            glm::dvec3 w =
                glm::transpose(to_world) * glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
            sum += f(image.radiance(f64::v3(w.x, w.y, w.z)), z);
        }
    }
    return sum * 2 * std::numbers::pi / (double(around) * up);
}

double irradiance(const SkyImage& image, const glm::dmat3& to_world) {
    return over_hemisphere(image, to_world, [](double l, double z) { return l * z; });
}

glm::dmat3 turned(const glm::dvec3& x, const glm::dvec3& about_y) {
    glm::dvec3 a = glm::normalize(x), c = glm::normalize(glm::cross(a, about_y));
    return {a, glm::cross(c, a), c};
}

} // namespace

TEST_CASE("envmap: what files say") {
    EnvmapEmitter plain = sky_in("");
    CHECK(plain.radiance == Rgb(1));
    CHECK(plain.to_world == glm::dmat3(1));
    CHECK(std::get<BitmapTexture>(plain.image.texture->kind).source.layout.width == 3);
    EnvmapEmitter other =
        sky_in("<float name='scale' value='2.5'/><float name='sampling_weight' value='1'/>"
               "<transform name='to_world'><scale value='3'/><scale x='-1'/>"
               "<rotate y='1' angle='90'/><translate x='7'/></transform>");
    CHECK(other.radiance == Rgb(2.5));
    CHECK(glm::length(other.to_world[0] - glm::dvec3(0, 0, 1)) < 1e-12);
    CHECK(glm::length(other.to_world[1] - glm::dvec3(0, 1, 0)) < 1e-12);
    CHECK(glm::length(other.to_world[2] - glm::dvec3(1, 0, 0)) < 1e-12);
    Scene noted = load_with_sky(envmap("<boolean name='mis_compensation' value='true'/>"));
    REQUIRE(noted.notes.size() == 1);
    CHECK_THAT(noted.notes[0], Contains("scene.xml:4") && Contains("mis_compensation"));
}

// Read from the tensors of Mitsuba 3.9.1: images of fewer than three rows repeat the last.
TEST_CASE("envmap: of fewer than three rows the last is there as often as is missing") {
    const SceneFolder folder;
    for (int rows : {1, 2, 3, 4}) {
        std::vector<float> values;
        for (int row = 0; row < rows; row++)
            for (int k = 0; k < 6; k++)
                values.push_back(static_cast<float>(row + 1) + 0.1F * static_cast<float>(k));
        folder.write("sky.pfm", pfm_of(2, rows, values, 3));
        const Scene scene =
            load_scene(folder.write("scene.xml", "<scene version='3.0.0'>\n" + envmap() +
                                                     "<shape type='sphere'/></scene>"));
        const auto& sky = std::get<EnvmapEmitter>(scene.emitters.at(0));
        const TexelSource& image = std::get<BitmapTexture>(sky.image.texture->kind).source;
        CHECK(image.layout.height == std::max(rows, 3));
        std::vector<float> read(image.layout.bytes() / sizeof(float));
        image.read(std::as_writable_bytes(std::span(read)));
        for (std::size_t i = 0; i < read.size(); i++) {
            const std::size_t row =
                std::min<std::size_t>(i / 6, static_cast<std::size_t>(rows) - 1);
            CHECK(read[i] == values[6 * row + i % 6]);
        }
    }
}

TEST_CASE("envmap: what cannot be a sky is refused with its line") {
    CHECK_THAT(refusal_with_sky(envmap("", "negative.pfm")),
               Contains("scene.xml:3") && Contains("-0.25") && Contains("negative.pfm"));
    CHECK_THAT(refusal_with_sky(envmap("", "nan.pfm")),
               Contains("scene.xml:3") && Contains("nan") && Contains("accepted"));
    CHECK_THAT(refusal_with_sky(envmap("", "none.pfm")),
               Contains("scene.xml:3") && Contains("none.pfm"));
    CHECK_THAT(refusal_with_sky(envmap("<transform name='to_world'><scale x='2'/></transform>")),
               Contains("scene.xml:4") && Contains("deforms the sky"));
    CHECK_THAT(refusal_with_sky(envmap("<float name='scale' value='-1'/>")),
               Contains("scene.xml:4") && Contains("scale"));
    CHECK_THAT(refusal_with_sky(envmap("<float name='gamma' value='2'/>")),
               Contains("scene.xml:4") && Contains("gamma"));
    CHECK_THAT(refusal_with_sky("<emitter type='constant'/>" + envmap()),
               Contains("a second emitter around the whole scene") && Contains("scene.xml:2"));
    CHECK_THAT(refusal_with_sky("<shape type='sphere'>" + envmap() + "</shape>"),
               Contains("cannot stand inside a <shape>"));
}

TEST_CASE("envmap: kernels have what it needs, and nothing of surfaces' textures") {
    Scene scene = square_under(sky_of(example_sky_texels()), 0.5);
    FeatureSet on = make_device_scene(scene).features.on();
    CHECK(on.has(feature_emitter_envmap));
    CHECK(on.has(feature_texels_half));
    for (Feature none : {feature_emitter_constant, feature_textures, feature_texture_bitmap,
                         feature_vertex_uvs, feature_texels_single, feature_light_tree})
        CHECK(!on.has(none));
    // A view of geometry reads no texels.
    auto broken = std::get<EnvmapEmitter>(scene.emitters[0]);
    auto texture = *broken.image.texture;
    std::get<BitmapTexture>(texture.kind).source.read = [](std::span<std::byte>) {
        throw InputError("read");
    };
    broken.image.texture = std::make_shared<const Texture>(texture);
    scene.emitters = {broken};
    CHECK_THROWS_WITH(make_device_scene(scene), "read");
    scene.integrator.kind = IntegratorKind::normals;
    CHECK(make_device_scene(scene).environment.texture == -1);
}

TEST_CASE("envmap: a black one is no light, and covers the pixel all the same") {
    Scene scene = square_under(sky_of(texels_of(2, 2, 1, TexelComponent::byte, {0, 0, 0, 0})), 0.5);
    DeviceScene flat = make_device_scene(scene);
    CHECK(flat.lights.empty());
    CHECK(!flat.features.has(feature_emitter_envmap));
    scene.film.pixel_format = PixelFormat::rgba;
    scene.camera.to_world[3].x = 100;
    CHECK(shown(scene) == 0);
    CHECK(shown(scene, "A") == 1);
}

TEST_CASE("envmap: bytes are decoded from sRGB, halves and floats are not") {
    auto seen = [](TexelComponent component, float value, bool srgb) {
        Scene scene = square_under(
            sky_of(texels_of(2, 3, 1, component, std::vector<float>(6, value), srgb)), 0.5);
        return sky_seen(make_device_scene(scene), {0.6f, 0.f, -0.8f}).radiance[1];
    };
    CHECK(seen(TexelComponent::byte, 128, true) == Approx(0.2158605).epsilon(1e-6)); // IEC 61966
    CHECK(seen(TexelComponent::byte, 128, false) == Approx(128 / 255.));
    CHECK(seen(TexelComponent::half, 300, false) == 300);
    CHECK(seen(TexelComponent::single, 70000.5f, false) == 70000.5f);
}

TEST_CASE("envmap: a matte square gets its irradiance, however the sky is turned") {
    constexpr double reflectance = 0.8;
    for (const SkyImage& image : sky_images())
        for (const glm::dmat3& to_world :
             {glm::dmat3(1), turned({0.3, 1, -0.2}, {0.1, 0.4, 1}),
              glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0))}) {
            CAPTURE(image.name, to_world[0].x);
            double truth = reflectance / std::numbers::pi * irradiance(image, to_world) * 3;
            Scene scene = square_under(envmap_of(image, Rgb(3), to_world), reflectance);
            double value = shown(scene);
            CHECK(value == Approx(truth).epsilon(image.name == "even" ? 1e-3 : 1e-2));
            scene.integrator.emitter_samples = false;
            if (image.name != "a small sun") CHECK(shown(scene) == Approx(truth).epsilon(4e-2));
        }
}

TEST_CASE("envmap: a sample has less than a tenth of the variance of uniform directions") {
    constexpr double reflectance = 0.8, brdf = reflectance / std::numbers::pi;
    const std::vector<SkyImage> skies = sky_images();
    auto sun = std::find_if(skies.begin(), skies.end(),
                            [](const SkyImage& sky) { return sky.name == "a small sun"; });
    REQUIRE(sun != skies.end());
    const glm::dmat3 up_is_z(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
    double mean = brdf * irradiance(*sun, up_is_z);
    double square = 2 * std::numbers::pi * over_hemisphere(*sun, up_is_z, [](double l, double z) {
                        return brdf * brdf * l * l * z * z;
                    });
    Scene scene = square_under(envmap_of(*sun, Rgb(1), up_is_z), reflectance);
    scene.integrator.aovs = {{"variance", "variance", {}}};
    scene.sampler.pattern = SamplePattern::independent;
    Image shown = host_render(scene, Precision::single_precision).image;
    CHECK(find_channel(shown, "R")->values[0] == Approx(mean).epsilon(1e-2));
    double variance = find_channel(shown, "variance.R")->values[0];
    CAPTURE(variance, square - mean * mean);
    CHECK(10 * variance < square - mean * mean);
}

TEST_CASE("envmap: its share of a light tree is that of its power") {
    Scene scene = square_under(sky_of(example_sky_texels(), Rgb(2, 1, 3)), 0.5);
    scene.emitters.emplace_back(ConstantEmitter{Rgb(2, 1, 3)});
    // Never both in a scene; but the table of lights can hold them, as it holds any two.
    DeviceScene flat = make_device_scene(scene);
    REQUIRE(flat.lights.size() == 2);
    double mean = flat.environment.mean;
    CHECK(flat.lights[0].pmf == Approx(mean / (mean + 1)).epsilon(1e-6));
}

TEST_CASE("envmap: what the kernels' table says does not depend on threads, and adds up") {
    Scene scene = square_under(envmap_of(sky_images()[3]), 0.5);
    DeviceScene flat = make_device_scene(scene), again = make_device_scene(scene);
    CHECK(flat.environment.shares == again.environment.shares);
    int width = sky_images()[3].width, rows = sky_images()[3].rows - 1;
    const auto& shares = flat.environment.shares;
    REQUIRE(shares.size() == std::size_t(rows + 1 + rows * (width + 1)));
    CHECK(shares[0] == 0);
    CHECK(shares[std::size_t(rows)] == 1 << 30);
    for (int row = 0; row < rows; row++)
        CHECK(shares[std::size_t(rows + 1 + row * (width + 1) + width)] == 1 << 30);
}
