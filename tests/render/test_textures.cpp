// Textures on the device: squares and texels that pixels coincide with, means over whole periods
// in a uniform sky, and the bits that the kernels compiled as C++ give.
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/kernel_ways.h"
#include "tests/support/example_textures.h"
#include "tests/support/host_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

constexpr int side = 8; ///< pixels

/// A square that fills the film, whose texture coordinates go from 0 to 1 to the right and up, in a
/// sky of radiance 1: a pixel is as bright as what it shows of the texture.
Scene square_in_sky(const Bsdf& bsdf, int samples) {
    Scene scene;
    scene.file = "made by the test";
    Mesh m = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    m.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.materials = {{"", {}, bsdf}};
    scene.shapes.push_back(shape_of(m, 0, no_material));
    scene.emitters = {ConstantEmitter{Rgb(1)}};
    constexpr double distance = 10;
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, distance, 1));
    scene.camera.fov_degrees = 360 / std::numbers::pi * std::atan(1 / distance);
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = side;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 2;
    // The sky is met, not sampled: what a path brings is what the surface reflects.
    scene.integrator.emitter_samples = false;
    scene.sampler.samples_per_pixel = samples;
    return scene;
}

Rgb pixel(const Image& image, int x, int y) {
    auto value = [&](const char* name) {
        return double{find_channel(image, name)->values[image.index(x, y)]};
    };
    return {value("R"), value("G"), value("B")};
}

void check_color(const Rgb& found, const Rgb& expected, double error) {
    for (int c = 0; c < 3; c++)
        CHECK(found[c] == Approx(expected[c]).margin(error));
}

/// Of `columns` x `rows` texels, all different, between 0 and 1.
std::vector<float> many_values(int columns, int rows) {
    std::vector<float> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
                              3);
    for (std::size_t k = 0; k < values.size(); k++)
        values[k] = std::fmod(0.371f * static_cast<float>(k) + 0.1f, 1.f);
    return values;
}

/// Every texel component, filter, wrap mode and kind of texture in turn.
class TexturesInTurn {
public:
    Textured<Rgb> next() {
        count_++;
        if (count_ % 4 == 0) return example_checkerboard();
        return textured(example_texels(components[count_ % 4 - 1]),
                        static_cast<TextureFilter>(count_ % 2),
                        static_cast<TextureWrap>(count_ % 3));
    }

private:
    static constexpr TexelComponent components[] = {TexelComponent::byte, TexelComponent::half,
                                                    TexelComponent::single};
    std::size_t count_ = 0;
};

/// Every kind of material with textures wherever it can have one.
void put_textures(Scene& scene) {
    TexturesInTurn textures;
    for (Material& m : scene.materials)
        std::visit(
            [&](auto& b) {
                if constexpr (requires { b.reflectance; }) b.reflectance = textures.next();
                if constexpr (requires { b.specular_reflectance; })
                    b.specular_reflectance = textures.next();
                if constexpr (requires { b.specular_transmittance; })
                    b.specular_transmittance = textures.next();
                if constexpr (requires { b.index; }) b.index = {textures.next(), textures.next()};
                if constexpr (requires { b.roughness.alpha_u; })
                    b.roughness.alpha_u = as_number(textures.next());
                if constexpr (requires { b.base_color; }) {
                    b.base_color = textures.next();
                    b.roughness = as_number(textures.next());
                    b.flatness = as_number(textures.next());
                }
            },
            m.bsdf);
}

const MeshAttributeTexture attribute_of_corners{"vertex_color", 0.9};
const MeshAttribute corner_colors{
    "vertex_color", 3, {0.1f, 0.9f, 0.3f, 0.5f, 0.2f, 0.8f, 0.7f, 0.6f, 0.4f, 0.3f, 1, 0}};

/// The wall's material is no other shape's: it can be an attribute of a mesh.
Scene every_kind_textured() {
    Scene scene = every_kind_scene();
    put_textures(scene);
    scene.materials.back().bsdf =
        DiffuseBsdf{textured(Texture{"", glm::dmat3(1), attribute_of_corners})};
    std::get<Mesh>(scene.shapes[1].geometry).attributes = {corner_colors};
    return scene;
}

/// A row of squares, of each texture one: little else that takes long to compile.
Scene textured_squares() {
    constexpr int squares = 13;
    TexturesInTurn textures;
    Scene scene = square_in_sky(DiffuseBsdf{textures.next()}, 3);
    const Shape whole = scene.shapes[0];
    scene.shapes.clear(), scene.materials.clear();
    for (int i = 0; i < squares; i++) {
        Mesh m = std::get<Mesh>(whole.geometry);
        for (auto& p : m.positions)
            p.x = (2.f * static_cast<float>(i) + 1 + p.x) / squares - 1;
        bool last = i == squares - 1;
        if (last) m.attributes = {corner_colors};
        scene.materials.push_back(
            {"",
             {},
             DiffuseBsdf{last ? textured(Texture{"", glm::dmat3(1), attribute_of_corners})
                              : textures.next()}});
        scene.shapes.push_back(shape_of(m, i, no_material));
    }
    return scene;
}

void check_bits_of_host(Scene scene, std::span<const KernelWay> ways) {
    scene.sampler.samples_per_pixel = 3;
    scene.integrator.aovs = {{"al", "albedo", {}}};
    Image host = host_render(scene, Precision::single_precision).image;
    for (const KernelWay& way : ways) {
        CAPTURE(way.name());
        RenderOptions options;
        options.lanes = way.lanes;
        options.portable = way.portable;
        CHECK(differing_values(render_quietly(scene, options).image, host).differing == 0);
    }
}

} // namespace

TEST_CASE("Textures: each pixel shows its square of a checkerboard", "[render]") {
    Rgb first(0.75, 0.25, 0.5), second(0.125, 0.625, 1);
    glm::dmat3 four_times(4, 0, 0, 0, 4, 0, 0, 0, 1);
    Bsdf bsdf = DiffuseBsdf{textured(Texture{"", four_times, CheckerboardTexture{first, second}})};
    Image image = render_quietly(square_in_sky(bsdf, 4)).image;
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            CAPTURE(x, y);
            // The square at (0, 0) is the first; it is at the bottom left.
            bool same = (x + (side - 1 - y)) % 2 == 0;
            check_color(pixel(image, x, y), same ? first : second, 1e-6);
        }
}

TEST_CASE("Textures: each pixel shows its texel, the image's first row at v = 0", "[render]") {
    std::vector<float> values = many_values(side, side);
    Bsdf bsdf = DiffuseBsdf{
        textured(texels_of(side, side, 3, TexelComponent::single, values), TextureFilter::nearest)};
    Image image = render_quietly(square_in_sky(bsdf, 4)).image;
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            CAPTURE(x, y);
            std::size_t at = 3 * static_cast<std::size_t>((side - 1 - y) * side + x);
            check_color(pixel(image, x, y), {values[at], values[at + 1], values[at + 2]}, 1e-6);
        }
}

TEST_CASE("Textures: over whole periods the mean is that of the texels", "[render]") {
    std::vector<float> values = many_values(5, 3);
    Rgb mean(0);
    for (std::size_t k = 0; k < values.size(); k++)
        mean[static_cast<int>(k % 3)] += values[k] / 15.0;
    for (TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror}) {
        Texture t{"", glm::dmat3(2, 0, 0, 0, 4, 0, 0.3, 0.4, 1),
                  BitmapTexture{texels_of(5, 3, 3, TexelComponent::single, values),
                                TextureFilter::bilinear, wrap}};
        Image image = render_quietly(square_in_sky(DiffuseBsdf{textured(t)}, 1024)).image;
        auto found = mean_rgb(image);
        for (int c = 0; c < 3; c++)
            CHECK(found[c] == Approx(mean[c]).margin(5e-4));
    }
}

TEST_CASE("Textures: a mirror's and a clear pane's colours are those of their textures",
          "[render]") {
    // Metal of index 0 and k 1 reflects everything, and the sky is the same everywhere.
    std::vector<float> values = many_values(side, side);
    auto image_of = [&] {
        return textured(texels_of(side, side, 3, TexelComponent::half, values),
                        TextureFilter::nearest);
    };
    ConductorBsdf mirror{{Rgb(0), Rgb(1)}, image_of()};
    ThinDielectricBsdf pane{1.5, image_of(), image_of()};
    for (const Bsdf& bsdf : {Bsdf(mirror), Bsdf(pane)}) {
        Scene scene = square_in_sky(bsdf, 4);
        scene.shapes[0].material_back = bsdf.index() == material_thindielectric ? 0 : no_material;
        Image image = render_quietly(scene).image;
        for (int y = 0; y < side; y++)
            for (int x = 0; x < side; x++) {
                CAPTURE(bsdf.index(), x, y);
                std::size_t at = 3 * static_cast<std::size_t>((side - 1 - y) * side + x);
                check_color(pixel(image, x, y), {values[at], values[at + 1], values[at + 2]}, 4e-4);
            }
    }
}

TEST_CASE("Textures: on every kind of material the kernels give the host's bits", "[render]") {
    check_bits_of_host(every_kind_textured(), std::span(kernel_ways).first(1));
}

TEST_CASE("Textures: every way to compile the kernels gives the bits of the host's", "[render]") {
    check_bits_of_host(textured_squares(), kernel_ways);
}
