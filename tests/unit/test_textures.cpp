// Textures as kernels look them up, by the albedo of what the camera sees: filters, what stands
// beyond an image, decoding, transforms, and what parameters of materials become.
#include "host/error.h"
#include "host/flatten/kind_names.h"
#include "host/flatten/material_records.h"
#include "host/flatten/texture_records.h"
#include "host/image/srgb.h"
#include "host/numerics/every_kind_scene.h"
#include "host/shared_maths.h"
#include "tests/support/example_textures.h"
#include "tests/support/host_render.h"
#include "tests/support/parameter_values.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

/// A camera of one pixel at (x, y, 10), so far that it sees nothing but the point (x, y) of a
/// square in the plane z = 0, whose texture coordinates are x and y from -3 to 3.
Scene look_at(const Bsdf& bsdf, double x, double y) {
    Scene scene;
    scene.file = "made by the test";
    Mesh m = quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0});
    m.uvs.clear();
    for (const glm::dvec3& p : m.positions)
        m.uvs.emplace_back(p.x, p.y);
    scene.materials = {{"", {}, bsdf}};
    scene.shapes.push_back(shape_of(m, 0, no_material));
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(x, y, 10, 1));
    scene.camera.fov_degrees = 1e-4;
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 1;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.kind = IntegratorKind::aov;
    scene.integrator.aovs = {{"a", "albedo", {}}};
    scene.sampler.samples_per_pixel = 1;
    return scene;
}

Rgb albedo(const Bsdf& bsdf, double x, double y, Precision precision) {
    Progress quiet(Progress::Mode::quiet);
    Image image = render_on_host(look_at(bsdf, x, y), {}, precision, quiet).image;
    auto value = [&](const char* name) { return double{find_channel(image, name)->values[0]}; };
    return {value("a.R"), value("a.G"), value("a.B")};
}

/// The texel of an image of which nothing is interpolated, by the documentation of wrap_mode.
int beyond(int n, int size, TextureWrap wrap) {
    int turned = ((n % size) + size) % size, twice = ((n % (2 * size)) + 2 * size) % (2 * size);
    if (wrap == TextureWrap::repeat) return turned;
    if (wrap == TextureWrap::mirror) return twice < size ? twice : 2 * size - 1 - twice;
    return std::min(std::max(n, 0), size - 1);
}

struct Looked {
    int width, height;
    std::vector<float> values; ///< three a texel
    TextureFilter filter;
    TextureWrap wrap;

    Rgb texel(int x, int y) const {
        auto at =
            3 * static_cast<std::size_t>(beyond(y, height, wrap) * width + beyond(x, width, wrap));
        return {values[at], values[at + 1], values[at + 2]};
    }
    Rgb at(double u, double v) const {
        double x = u * width, y = v * height;
        if (filter == TextureFilter::nearest)
            return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
        double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
        double a = x - 0.5 - left, b = y - 0.5 - top;
        int i = static_cast<int>(left), j = static_cast<int>(top);
        return (texel(i, j) * (1 - a) + texel(i + 1, j) * a) * (1 - b) +
               (texel(i, j + 1) * (1 - a) + texel(i + 1, j + 1) * a) * b;
    }
};

void check_color(const Rgb& found, const Rgb& expected, double error = 3e-5) {
    for (int c = 0; c < 3; c++)
        CHECK(found[c] == Approx(expected[c]).margin(error));
}

/// A ball in a sky of three colours that a light beside it makes uneven.
Scene ball_in_sky(const Bsdf& bsdf) {
    Scene scene = look_at(bsdf, 0, 0);
    scene.shapes = {shape_of(Sphere{}, 0, is_opaque(bsdf) ? no_material : 0)};
    scene.emitters = {ConstantEmitter{Rgb(1, 0.8, 0.6)},
                      DirectionalEmitter{glm::normalize(glm::dvec3(-1, -1, -1)), Rgb(2, 3, 4)}};
    scene.camera.fov_degrees = 12;
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 4;
    scene.integrator = {};
    scene.integrator.max_depth = 4;
    scene.sampler.samples_per_pixel = 16;
    return scene;
}

Rgb mean_of(const Image& image) {
    auto mean = [&](const char* name) {
        double sum = 0;
        for (float value : find_channel(image, name)->values)
            sum += value;
        return sum / static_cast<double>(image.pixel_count());
    };
    return {mean("R"), mean("G"), mean("B")};
}

/// The first numbers are the parameters below, those from here on Burley's in turn.
constexpr int burleys = 5, burleys_end = burleys + 11;

/// Sets the parameter of that number: reflectance, transmittance, eta, k, roughness, then Burley's;
/// whether there is one. Where a texture leaves energy compensation out, that is left out.
bool set_textured(auto& b, int parameter, const Textured<Rgb>& value) {
    bool there = false;
    auto set = [&](auto& to) { to = value, there = true; };
    if constexpr (requires { b.energy_compensation; }) b.energy_compensation = parameter < 2;
    if constexpr (requires { b.reflectance; })
        if (parameter == 0) set(b.reflectance);
    if constexpr (requires { b.specular_reflectance; })
        if (parameter == 0) set(b.specular_reflectance);
    if constexpr (requires { b.base_color; })
        if (parameter == 0) set(b.base_color);
    int number = burleys;
    each_parameter(b, [&](auto, const char*, auto& v) {
        if constexpr (std::same_as<decltype(v), Textured<double>&>)
            if (number++ == parameter) {
                v = value.texture ? as_number(value) : Textured<double>(value.constant.r);
                there = true;
            }
    });
    if constexpr (requires { b.specular_transmittance; })
        if (parameter == 1) set(b.specular_transmittance);
    if constexpr (requires { b.index; })
        if (parameter == 2 || parameter == 3) set(parameter == 2 ? b.index.eta : b.index.k);
    if constexpr (requires { b.roughness.alpha_u; })
        if (parameter == 4) {
            b.roughness.alpha_u =
                value.texture ? as_number(value) : Textured<double>(value.constant.r);
            there = true;
        }
    return there;
}

const std::vector<glm::dvec2> places{{0.01, 0.02},   {0.49, 0.51},  {0.91, 0.97},  {1.31, 0.22},
                                     {-0.04, -0.07}, {-1.21, 2.43}, {2.63, -2.33}, {0.23, 1.83}};

} // namespace

TEST_CASE("Textures: filters and wrap modes give what their documentation says", "[textures]") {
    std::vector<float> values(5 * 4 * 3);
    for (std::size_t k = 0; k < values.size(); k++)
        values[k] = std::fmod(0.37f * static_cast<float>(k), 1.f);
    for (TextureFilter filter : {TextureFilter::bilinear, TextureFilter::nearest})
        for (TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
            Looked truth{5, 4, values, filter, wrap};
            Bsdf bsdf = DiffuseBsdf{
                textured(texels_of(5, 4, 3, TexelComponent::single, values), filter, wrap)};
            for (const glm::dvec2& at : places)
                for (Precision precision :
                     {Precision::single_precision, Precision::double_precision}) {
                    CAPTURE(static_cast<int>(filter), static_cast<int>(wrap), at.x, at.y);
                    check_color(albedo(bsdf, at.x, at.y, precision), truth.at(at.x, at.y));
                }
        }
}

TEST_CASE("Textures: components of every kind and number are decoded", "[textures]") {
    auto at = [](const Textured<Rgb>& color, double x) {
        return albedo(DiffuseBsdf{color}, x, 0.5, Precision::single_precision);
    };
    auto image = [&](TexelComponent component, int channels, const std::vector<float>& values,
                     bool srgb = false, bool raw = false) {
        return textured(texels_of(2, 1, channels, component, values, srgb), TextureFilter::nearest,
                        TextureWrap::repeat, raw);
    };
    auto decoded = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    std::vector<float> bytes{5, 100, 255, 0, 10, 11};
    for (int k = 0; k < 2; k++) {
        Rgb value(bytes[3 * k], bytes[3 * k + 1], bytes[3 * k + 2]);
        value /= 255.0;
        check_color(at(image(TexelComponent::byte, 3, bytes), k ? 0.75 : 0.25), value, 1e-7);
        check_color(at(image(TexelComponent::byte, 3, bytes, true), k ? 0.75 : 0.25),
                    {decoded(value.r), decoded(value.g), decoded(value.b)}, 1e-7);
        check_color(at(image(TexelComponent::byte, 3, bytes, true, true), k ? 0.75 : 0.25), value,
                    1e-7);
    }
    check_color(at(image(TexelComponent::byte, 1, {7, 200}), 0.75), Rgb(200 / 255.0), 1e-7);
    // Of halves a subnormal, the largest below 1, and one of each exponent's parity.
    std::vector<float> halves{0x1p-24f, 0.99951171875f, 0.0007f, 0x3ffp-24f, 0.25f, 0.625f};
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < 3; c++)
            CHECK(at(image(TexelComponent::half, 3, halves), k ? 0.75 : 0.25)[c] ==
                  static_cast<float>(Imath::half(halves[3 * k + c])));
    check_color(at(image(TexelComponent::half, 1, {0.5f, 0.75f}), 0.25), Rgb(0.5), 0);
    check_color(at(image(TexelComponent::single, 1, {0.3f, 0.75f}), 0.25), Rgb(0.3f), 0);
    // Floats that stand for 16 bits of sRGB.
    check_color(at(image(TexelComponent::single, 3, {0, 0.02f, 0.5f, 1, 0, 0}, true), 0.25),
                {0, decoded(0.02), decoded(0.5)}, 1e-7);
    check_color(at(image(TexelComponent::single, 3, {0, 0.02f, 0.5f, 1, 0, 0}, true, true), 0.25),
                {0, 0.02, 0.5}, 1e-7);
}

TEST_CASE("Textures: bytes stand for correctly rounded values", "[textures]") {
    std::vector<float> values = make_byte_values();
    REQUIRE(values.size() == BYTE_VALUES);
    for (int byte = 0; byte < 256; byte++) {
        long double e = byte / 255.0L;
        long double linear =
            e <= 0.04045L ? e / 12.92L : std::pow((e + 0.055L) / 1.055L, 2.4L); // IEC 61966-2-1
        CHECK(values[byte] == static_cast<float>(linear));
        CHECK(values[256 + byte] == static_cast<float>(e));
    }
    CHECK(values[255] == 1.f);
}

TEST_CASE("Textures: a checkerboard has squares of half a unit", "[textures]") {
    Rgb first(0.2, 0.3, 0.6), second(0.7, 0.5, 0.4);
    glm::dmat3 to_uv(3, 0.5, 0, -1, 2, 0, 0.1, 0.2, 1); // by columns
    Bsdf bsdf = DiffuseBsdf{textured(Texture{"", to_uv, CheckerboardTexture{first, second}})};
    int seen = 0;
    for (const glm::dvec2& at : places) {
        double u = 3 * at.x - at.y + 0.1, v = 0.5 * at.x + 2 * at.y + 0.2;
        bool same = (u - std::floor(u) > 0.5) == (v - std::floor(v) > 0.5);
        seen |= same ? 1 : 2;
        CAPTURE(at.x, at.y);
        check_color(albedo(bsdf, at.x, at.y, Precision::single_precision), same ? first : second,
                    1e-7);
    }
    CHECK(seen == 3);
}

TEST_CASE("Textures: materials know which of their parameters are textures", "[textures]") {
    Textured<Rgb> a = example_checkerboard(), b = example_bitmap();
    RoughConductorBsdf metal;
    metal.index.k = a;
    metal.specular_reflectance = b;
    metal.roughness.alpha_v = as_number(a);
    Scene scene = look_at(metal, 0, 0);
    scene.materials.push_back({"", {}, DiffuseBsdf{b}});
    scene.materials.push_back({"", {}, DielectricBsdf{1.5, 0.5, a}});
    DeviceScene flat = make_device_scene(scene);
    // Rows in the order of first use, each texture once: k before the reflectance.
    REQUIRE(flat.textures.size() == 2);
    const MaterialTexturesRecord &m = flat.material_textures[0], &d = flat.material_textures[1],
                                 &g = flat.material_textures[2];
    int checkerboard = m.k, bitmap = m.reflectance;
    CHECK(TEXTURE_KIND(flat.textures[checkerboard].form) == texture_checkerboard);
    CHECK(TEXTURE_KIND(flat.textures[bitmap].form) == texture_bitmap);
    CHECK(m.alpha_v == checkerboard);
    CHECK(m.alpha_u == -1);
    CHECK(m.eta == -1);
    CHECK(m.transmittance == -1);
    CHECK(d.reflectance == bitmap);
    CHECK(g.transmittance == checkerboard);
    CHECK(g.reflectance == -1);
    CHECK(flat.features.has(feature_anisotropy));
    CHECK(flat.features.has(feature_textured_index));
    CHECK(flat.materials[0].alpha_v == 1.f);
    CHECK(flat.materials[2].r == 0.5f);
    // Views of geometry read no texels.
    scene.integrator.kind = IntegratorKind::normals;
    scene.integrator.aovs.clear();
    flat = make_device_scene(scene);
    CHECK(flat.textures.empty());
    CHECK(flat.texels.empty());
    CHECK_FALSE(flat.features.has(feature_textures));
}

TEST_CASE("Textures: one that is the same everywhere is as good as a constant", "[textures]") {
    // Of each parameter that can be one, in each kind of material; a half of 0.5 is exact.
    auto flat = [] {
        return textured(texels_of(2, 3, 3, TexelComponent::half, std::vector<float>(18, 0.5f)));
    };
    int compared = 0;
    for (const Bsdf& base : every_unlike_bsdf())
        for (int parameter = 0; parameter < burleys_end; parameter++) {
            Bsdf constant = base, told = base;
            bool there = std::visit(
                [&](auto& b) { return set_textured(b, parameter, Textured<Rgb>(0.5)); }, constant);
            std::visit([&](auto& b) { return set_textured(b, parameter, flat()); }, told);
            if (!there) continue;
            compared++;
            CAPTURE(material_names[base.index()], parameter);
            auto mean = [&](const Bsdf& bsdf) {
                return mean_of(host_render(ball_in_sky(bsdf), Precision::double_precision).image);
            };
            Rgb expected = mean(constant), found = mean(told);
            for (int c = 0; c < 3; c++)
                CHECK(found[c] == Approx(expected[c]).epsilon(1e-5));
            // And it makes a difference.
            CHECK(mean(base) != expected);
        }
    CHECK(compared >= 15 + 2 + 11 + 9);
}

TEST_CASE("Textures: a number is an image's luminance, of a checkerboard the other colour's mean",
          "[textures]") {
    // Wherever it is looked up, at (1/4, 1/4). Mitsuba 3.9.1 says so of the same checkerboard: its
    // eval is color0 there, its eval_1 that of color1, which is the mean of its channels; of an
    // image eval_1 is this sum.
    Rgb other(0.9, 0.05, 0.1), told(0.1, 0.5, 0.3);
    double luminance = 0.212671 * told.r + 0.715160 * told.g + 0.072169 * told.b;
    double of_channels = (told.r + told.g + told.b) / 3;
    glm::dmat3 to_one_place(0, 0, 0, 0, 0, 0, 0.25, 0.25, 1);
    Textured<Rgb> board = textured(Texture{"", to_one_place, CheckerboardTexture{other, told}});
    std::vector<float> texel{static_cast<float>(told.r), static_cast<float>(told.g),
                             static_cast<float>(told.b)};
    Textured<Rgb> image = textured(texels_of(1, 1, 3, TexelComponent::single, texel));
    auto mean = [](const Textured<double>& alpha) {
        RoughConductorBsdf metal;
        metal.energy_compensation = false;
        metal.roughness.alpha_u = metal.roughness.alpha_v = alpha;
        return mean_of(host_render(ball_in_sky(metal), Precision::double_precision).image);
    };
    CHECK(mean(luminance).r != Approx(mean(of_channels).r).epsilon(1e-4));
    for (int c = 0; c < 3; c++) {
        CHECK(mean(as_number(board))[c] == Approx(mean(of_channels)[c]).epsilon(1e-5));
        CHECK(mean(as_number(image))[c] == Approx(mean(luminance)[c]).epsilon(1e-5));
    }
}

TEST_CASE("Textures: values that a parameter cannot take are refused", "[textures]") {
    auto refusal = [](const std::vector<float>& values, Domain domain) -> std::string {
        TexelSource source = texels_of(1, 2, 1, TexelComponent::single, values);
        source.name = "wild.exr";
        Textured<Rgb> color = textured(Texture{"", glm::dmat3(1), BitmapTexture{source}}, domain);
        try {
            make_device_scene(look_at(DiffuseBsdf{color}, 0, 0));
            return "";
        } catch (const InputError& error) {
            return error.what();
        }
    };
    CHECK(refusal({0, 1}, between(0, 1)).empty());
    CHECK_THAT(refusal({0, 1.5f}, between(0, 1)),
               Contains("a parameter of the test gets values from 0 to 1.5 of wild.exr (accepted: "
                        "0 to 1)"));
    CHECK_THAT(refusal({-1, 1}, between(0, 1)), Contains("values from -1 to 1"));
    CHECK_THAT(refusal({0, NAN}, any_number()), Contains("nan"));
    CHECK_THAT(refusal({INFINITY, 0}, any_number()), Contains("inf"));
}

TEST_CASE("Textures: a shape of any kind shows them, whether layers are asked for or not",
          "[textures]") {
    // In a sky of 1 a matte surface is as bright as it reflects, but for what meets itself: a
    // cylinder's inside.
    for (std::size_t k = 0; k < example_shapes.size(); k++) {
        CAPTURE(k);
        Scene scene = look_at(DiffuseBsdf{}, 0, 0);
        glm::dmat3 to_uv(4, 0, 0, 0, 4, 0, 0, 0, 1);
        std::get<DiffuseBsdf>(scene.materials[0].bsdf).reflectance =
            textured(Texture{"", to_uv, CheckerboardTexture{Rgb(0.9), Rgb(0.1)}});
        scene.shapes = {shape_of(example_shapes[k]({0, 0, 0}, 1), 0, 0)};
        scene.emitters = {ConstantEmitter{Rgb(1)}};
        scene.camera.fov_degrees = 5;
        scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 16;
        Image albedo = host_render(scene, Precision::double_precision).image;
        scene.integrator = {};
        scene.integrator.max_depth = 2, scene.integrator.emitter_samples = false;
        scene.integrator.hide_emitters = true;
        Image seen = host_render(scene, Precision::double_precision).image;
        const auto &a = find_channel(albedo, "a.R")->values, &r = find_channel(seen, "R")->values;
        int light = 0, dark = 0;
        for (std::size_t i = 0; i < a.size(); i++) {
            if (r[i] > 0) CHECK(r[i] == Approx(a[i]).margin(1e-5));
            light += r[i] > 0.8f, dark += r[i] > 0.05f && r[i] < 0.2f;
        }
        CHECK(light > 5);
        CHECK(dark > 5);
    }
}
