// Cryptomatte: hashes against published ones, coverage against the film's own mean of shape
// numbers.
#include "host/commands/picture_form.h"
#include "host/error.h"
#include "host/film/cryptomatte.h"
#include "host/numerics/every_kind_scene.h"
#include "tests/support/host_render.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <map>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

constexpr int deep = 64; ///< more names than any pixel here has

Scene asking(Scene scene, int depth = deep) {
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        scene.shapes[i].id = fmt::format("s{}", i);
        scene.shapes[i].bsdf_id = fmt::format("b{}", i % 3);
    }
    scene.integrator.cryptomatte = {true, true, depth};
    return scene;
}

Image image_of(const Scene& scene, const RenderOptions& options = {}) {
    return host_render(scene, Precision::single_precision, options).image;
}

const std::vector<float>& values(const Image& image, const std::string& channel) {
    const Channel* const found = find_channel(image, channel);
    REQUIRE(found);
    return found->values;
}

struct Covering {
    std::uint32_t id;
    double share;
};

/// What the ranks of a pixel say, those that are none left out.
std::vector<Covering> covering(const Image& image, const std::string& layer, int depth,
                               std::size_t pixel) {
    std::vector<Covering> ranks;
    for (int r = 0; r < depth; r++) {
        const std::string name = fmt::format("{}{:02}.", layer, r / 2);
        const float id = values(image, name + "RB"[r % 2])[pixel];
        const float share = values(image, name + "GA"[r % 2])[pixel];
        if (id != 0 || share != 0) ranks.push_back({std::bit_cast<std::uint32_t>(id), share});
    }
    return ranks;
}

std::map<std::uint32_t, std::size_t> shapes_by_id(const Scene& scene) {
    std::map<std::uint32_t, std::size_t> shapes;
    for (std::size_t i = 0; i < scene.shapes.size(); i++)
        shapes[cryptomatte_id(scene.shapes[i].id)] = i;
    return shapes;
}

std::string attribute(const Image& image, const std::string& name) {
    for (const auto& [key, value] : image.metadata)
        if (key == name) return std::get<std::string>(value);
    return "none";
}

} // namespace

TEST_CASE("Cryptomatte: hashes are MurmurHash3's", "[cryptomatte]") {
    CHECK(murmur_hash("") == 0);
    CHECK(murmur_hash("test") == 0xba6bd213);
    CHECK(murmur_hash("Hello, world!") == 0xc0363e43);
    CHECK(murmur_hash("The quick brown fox jumps over the lazy dog") == 0x2e4ff723);
}

TEST_CASE("Cryptomatte: every id is a number, whose exponent alone may differ from the hash",
          "[cryptomatte]") {
    int changed = 0;
    for (int i = 0; i < 4096; i++) {
        const std::string name = fmt::format("name{}", i);
        const std::uint32_t id = cryptomatte_id(name), hash = murmur_hash(name);
        CHECK(std::isnormal(std::bit_cast<float>(id)));
        const bool none = !std::isnormal(std::bit_cast<float>(hash));
        CHECK(id == (none ? hash ^ 0x800000u : hash));
        changed += none;
    }
    CHECK(changed > 8); // 1 in 128
}

TEST_CASE("Cryptomatte: shares of shapes make the mean of their numbers", "[cryptomatte]") {
    struct Way {
        FilterKind filter;
        FilterMethod method;
    };
    for (const Way& way : {Way{FilterKind::box, FilterMethod::splatting},
                           {FilterKind::tent, FilterMethod::splatting},
                           {FilterKind::gaussian, FilterMethod::splatting},
                           {FilterKind::gaussian, FilterMethod::sampling}}) {
        Scene scene = asking(every_kind_scene());
        scene.film.filter.kind = way.filter, scene.film.filter_method = way.method;
        scene.integrator.aovs = {{"i", "shape_index", {}}};
        const Image image = image_of(scene);
        const auto shapes = shapes_by_id(scene);
        double worst = 0;
        std::size_t several = 0;
        for (std::size_t pixel = 0; pixel < image.pixel_count(); pixel++) {
            double mean = 0;
            const auto ranks = covering(image, "CryptoObject", deep, pixel);
            for (const Covering& c : ranks)
                mean += c.share * static_cast<double>(shapes.at(c.id) + 1);
            several += ranks.size() > 1;
            worst =
                std::max(worst, std::fabs(mean - static_cast<double>(values(image, "i.I")[pixel])));
        }
        // Up to 30 shapes, whose weights the film knows in single precision.
        CHECK(worst < 30 * 30 * 0x1p-23);
        CHECK(several > image.pixel_count() / 10);
    }
}

TEST_CASE("Cryptomatte: ranks fall, and fewer are the first of more", "[cryptomatte]") {
    for (FilterKind filter : {FilterKind::box, FilterKind::mitchell, FilterKind::lanczos}) {
        Scene scene = every_kind_scene();
        scene.film.filter.kind = filter;
        const Image all = image_of(asking(scene));
        for (int depth : {1, 2, 3, 6}) {
            const Image few = image_of(asking(scene, depth));
            CHECK(find_channel(few, fmt::format("CryptoObject{:02}.R", (depth + 1) / 2)) ==
                  nullptr);
            for (const char* layer : {"CryptoObject", "CryptoMaterial"})
                for (std::size_t pixel = 0; pixel < all.pixel_count(); pixel++) {
                    const auto more = covering(all, layer, deep, pixel),
                               ranks = covering(few, layer, depth, pixel);
                    bool good =
                        ranks.size() == std::min(more.size(), static_cast<std::size_t>(depth));
                    for (std::size_t r = 0; good && r < ranks.size(); r++)
                        good = ranks[r].id == more[r].id && ranks[r].share == more[r].share &&
                               ranks[r].share > 0 &&
                               (r == 0 || ranks[r].share <= ranks[r - 1].share);
                    if (!good) FAIL(layer << " at pixel " << pixel);
                }
        }
    }
}

TEST_CASE("Cryptomatte: shapes of one bsdf are one material", "[cryptomatte]") {
    const Scene scene = asking(every_kind_scene());
    const Image image = image_of(scene);
    const auto shapes = shapes_by_id(scene);
    for (std::size_t pixel = 0; pixel < image.pixel_count(); pixel++) {
        std::map<std::uint32_t, double> materials;
        for (const Covering& c : covering(image, "CryptoObject", deep, pixel))
            materials[cryptomatte_id(scene.shapes[shapes.at(c.id)].bsdf_id)] += c.share;
        const auto ranks = covering(image, "CryptoMaterial", deep, pixel);
        REQUIRE(ranks.size() == materials.size());
        for (const Covering& c : ranks)
            CHECK(c.share == Approx(materials.at(c.id)).epsilon(30 * 0x1p-24));
    }
}

TEST_CASE("Cryptomatte: the same bits however work is split, of a crop, and of the image beside",
          "[cryptomatte]") {
    const Scene plain = every_kind_scene(), scene = asking(plain, 6);
    const Image whole = image_of(scene), without = image_of(plain);
    for (const Channel& channel : without.channels)
        CHECK(values(whole, channel.name) == channel.values);
    RenderOptions small;
    small.split.pool_paths = 512;
    const Image split = image_of(scene, small);
    for (const Channel& channel : whole.channels)
        CHECK(values(split, channel.name) == channel.values);
    Scene cropped = scene;
    cropped.film.crop_x = 11, cropped.film.crop_y = 5;
    cropped.film.crop_width = 14, cropped.film.crop_height = 13;
    const Image part = image_of(cropped);
    for (int y = 0; y < part.height; y++)
        for (int x = 0; x < part.width; x++)
            for (const char* channel : {"CryptoObject00.G", "CryptoObject01.R"})
                CHECK(values(part, channel)[part.index(x, y)] ==
                      values(whole, channel)[whole.index(x + 11, y + 5)]);
}

TEST_CASE("Cryptomatte: names are ids of the file, and the header says which", "[cryptomatte]") {
    Scene scene = load_body(
        "<bsdf type='diffuse' id='paint'/>"
        "<shape type='sphere' id='ball'><ref id='paint'/></shape>"
        "<shape type='sphere' id='bare'/>"
        "<shape type='disk'><bsdf type='conductor'/></shape>"
        "<shape type='disk' id='&#228;&quot;'><bsdf type='conductor' id='gold'/></shape>");
    scene.integrator.cryptomatte = {true, true, 6};
    const Cryptomatte mattes = cryptomatte_of(scene);
    REQUIRE(mattes.layers.size() == 2);
    CHECK(mattes.layers[0].names ==
          std::vector<std::string>{"ball", "bare", "shape 3", "\u00e4\""});
    CHECK(mattes.layers[1].names ==
          std::vector<std::string>{"paint", "default", "shape 3.bsdf", "gold"});
    Image image = make_image(1, 1);
    struct Nothing : FilmSums {
        void add_row(int, int, SumRow&) const override {}
    };
    add_cryptomatte(Nothing(), mattes, 0, image);
    add_cryptomatte_header(mattes, image);
    CHECK(image.channels.size() == 24);
    for (const Channel& channel : image.channels)
        CHECK(channel.values == std::vector<float>{0});
    const std::string key =
        "cryptomatte/" + fmt::format("{:08x}", cryptomatte_id("CryptoObject")).substr(0, 7) + "/";
    CHECK(attribute(image, key + "name") == "CryptoObject");
    CHECK(attribute(image, key + "hash") == "MurmurHash3_32");
    CHECK(attribute(image, key + "conversion") == "uint32_to_float32");
    CHECK_THAT(attribute(image, key + "manifest"),
               Contains(fmt::format("\"ball\":\"{:08x}\"", cryptomatte_id("ball"))));
}

TEST_CASE("Cryptomatte: what would change names is refused, and floats stay floats",
          "[cryptomatte]") {
    FilmContent content;
    content.cryptomatte.layers = {{"CryptoObject", {"ball"}}};
    for (ComponentFormat format : {ComponentFormat::float16, ComponentFormat::uint32}) {
        content.film.component_format = format;
        CHECK(exr_options({}, content).component_of("CryptoObject02.A") ==
              ComponentFormat::float32);
        CHECK(exr_options({}, content).component_of("R") == format);
    }
    for (const char* lossy : {"pxr24", "dwaa", "dwab"})
        CHECK_THROWS_WITH(exr_options({.compression = lossy}, content), Contains("names of layer"));
    for (const char* kept : {"none", "rle", "zips", "zip", "piz", "b44", "b44a"})
        CHECK_NOTHROW(exr_options({.compression = kept}, content));
    CHECK_THROWS_WITH(exr_options({.layer_formats = {"CryptoObject00=half"}}, content),
                      Contains("names of that layer"));
}
