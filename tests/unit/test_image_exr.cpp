// EXR writing and reading back: bits, layers, metadata, windows, component formats.
#include "host/image/exr.h"
#include "test_image_tools.h"

#include <half.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

using namespace parhelion;
using namespace image_test;

namespace {

/// Random bits: every kind of float, NaN and infinity included.
std::vector<float> random_floats(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> values(count);
    for (float& value : values)
        value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    return values;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), 4 * a.size()) == 0;
}

Image sample_image(int width, int height) {
    Image image = make_image(width, height);
    const std::size_t count = image.pixel_count();
    add_rgb_layer(image, "", random_floats(3 * count, 1));
    add_channel(image, "A", random_floats(count, 2));
    add_rgb_layer(image, "albedo", random_floats(3 * count, 3));
    const std::vector<std::string> xyz{"X", "Y", "Z"};
    add_layer(image, "sh_normal", xyz, random_floats(3 * count, 4));
    add_channel(image, "depth.T", random_floats(count, 5));
    return image;
}

MetadataValue metadata(const Image& image, const std::string& name) {
    for (const auto& [key, value] : image.metadata)
        if (key == name) return value;
    FAIL("no metadata " << name);
    return {};
}

} // namespace

TEST_CASE("EXR: every float of every layer comes back to the bit") {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {37, 131}, {64, 64}, {3, 257}}) {
        const Image image = sample_image(width, height);
        const std::string file = folder.file("image.exr");
        static_cast<void>(write_exr(file, image)); // some are not finite
        const Image back = read_exr(file);
        CHECK(back.width == width);
        CHECK(back.height == height);
        CHECK(back.channels.size() == image.channels.size());
        for (const Channel& channel : image.channels) {
            const Channel* found = find_channel(back, channel.name);
            REQUIRE(found);
            CHECK(same_bits(found->values, channel.values));
        }
    }
    CHECK(folder.entries() == 1);
}

TEST_CASE("EXR: the top row comes first and x runs to the right") {
    const TemporaryFolder folder;
    Image image = make_image(3, 2);
    add_channel(image, "Y", {1, 2, 3, 4, 5, 6});
    CHECK(write_exr(folder.file("a.exr"), image).empty());
    CHECK(read_exr(folder.file("a.exr")).channels.at(0).values ==
          std::vector<float>{1, 2, 3, 4, 5, 6});
}

TEST_CASE("EXR: crops keep their place in the frame") {
    const TemporaryFolder folder;
    Image image = make_image(5, 4);
    image.full_width = 640;
    image.full_height = 480;
    image.offset_x = 100;
    image.offset_y = 470;
    add_channel(image, "Y", random_floats(20, 9));
    static_cast<void>(write_exr(folder.file("crop.exr"), image)); // some are not finite
    const Image back = read_exr(folder.file("crop.exr"));
    CHECK(back.width == 5);
    CHECK(back.height == 4);
    CHECK(back.full_width == 640);
    CHECK(back.full_height == 480);
    CHECK(back.offset_x == 100);
    CHECK(back.offset_y == 470);
    CHECK(same_bits(back.channels.at(0).values, image.channels[0].values));
}

TEST_CASE("EXR: metadata comes back with its type") {
    const TemporaryFolder folder;
    Image image = make_image(1, 1);
    add_channel(image, "Y", {0});
    image.metadata = {{"scene", std::string("a scene.xml")},
                      {"parhelion.render_seconds", 1.25},
                      {"spp", std::int64_t(64)},
                      {"negative", std::int64_t(-1)},
                      {"seed", std::int64_t(4294967295)}};
    CHECK(write_exr(folder.file("m.exr"), image).empty());
    const Image back = read_exr(folder.file("m.exr"));
    CHECK(std::get<std::string>(metadata(back, "scene")) == "a scene.xml");
    CHECK(std::get<double>(metadata(back, "parhelion.render_seconds")) == 1.25);
    CHECK(std::get<std::int64_t>(metadata(back, "spp")) == 64);
    CHECK(std::get<std::int64_t>(metadata(back, "negative")) == -1);
    // EXR has no integer above 32 bits.
    CHECK(std::get<std::string>(metadata(back, "seed")) == "4294967295");
    CHECK(back.metadata.size() == 5);

    image.metadata = {{"dataWindow", std::string("mine")}};
    CHECK_THROWS_AS(write_exr(folder.file("n.exr"), image), std::invalid_argument);
    CHECK(folder.entries() == 1);
}

TEST_CASE("EXR: float16 rounds to nearest and counts what becomes infinite") {
    const TemporaryFolder folder;
    const float infinity = std::numeric_limits<float>::infinity();
    Image image = make_image(7, 1);
    add_channel(image, "Y", {0.1f, -2.0f, 65504.0f, 65519.0f, 65520.0f, -1e30f, infinity});
    const std::vector<Misfits> misfits =
        write_exr(folder.file("h.exr"), image, {ComponentFormat::float16});
    REQUIRE(misfits.size() == 1);
    CHECK((misfits[0].not_finite == 1 && misfits[0].out_of_range == 2));
    CHECK((misfits[0].x == 4 && misfits[0].y == 0 && misfits[0].value == 65520.0f));
    const std::vector<float> back = read_exr(folder.file("h.exr")).channels.at(0).values;
    CHECK(back == std::vector<float>{0.0999755859375f, -2.0f, 65504.0f, 65504.0f, infinity,
                                     -infinity, infinity});
}

TEST_CASE("EXR: uint32 rounds to the nearest integer and counts what does not fit") {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image image = make_image(6, 1);
    add_channel(image, "Y", {0.4f, 1.6f, 16777215.0f, -0.4f, -3.0f, nan});
    CHECK(misfit_count(write_exr(folder.file("u.exr"), image, {ComponentFormat::uint32})) == 2);
    CHECK(read_exr(folder.file("u.exr")).channels.at(0).values ==
          std::vector<float>{0, 2, 16777215.0f, 0, 0, 0});

    image.channels[0].values[0] = 16777216.0f;
    image.channels[0].values[1] = 1e20f;
    CHECK(misfit_count(write_exr(folder.file("big.exr"), image, {ComponentFormat::uint32})) == 3);
    const std::string message = refusal([&] { read_exr(folder.file("big.exr")); });
    CHECK_THAT(message, Catch::Contains("channel Y holds unsigned integers of 2^24"));
}

TEST_CASE("EXR: of every layer, what is not finite and where it begins, in pixels of the frame") {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const int rows = 600; // more than are converted at a time
    Image image = make_image(2, rows);
    image.full_width = 10, image.full_height = 1000, image.offset_x = 7, image.offset_y = 30;
    for (const char* name : {"R", "A", "variance.G", "depth.T"})
        add_channel(image, name, std::vector<float>(image.pixel_count(), 1.0f));
    image.channels[0].values.back() = 3e38f; // float32 holds it
    image.channels[1].values[image.index(0, 500)] = -infinity;
    image.channels[2].values[image.index(1, 300)] = nan;
    image.channels[2].values[image.index(0, 301)] = infinity;
    const std::vector<Misfits> misfits = write_exr(folder.file("a.exr"), image);
    REQUIRE(misfits.size() == 2);
    CHECK((misfits[0].channel == "A" && misfits[0].count() == 1));
    CHECK((misfits[0].x == 7 && misfits[0].y == 530 && misfits[0].value == -infinity));
    CHECK((misfits[1].channel == "variance.G" && misfits[1].not_finite == 2));
    CHECK((misfits[1].x == 8 && misfits[1].y == 330 && std::isnan(misfits[1].value)));
    CHECK(misfit_count(misfits) == 3);
    // No format makes a finite number of it.
    const auto as_half = write_exr(folder.file("h.exr"), image, {ComponentFormat::float16});
    CHECK(misfit_count(as_half) == 4);
    CHECK(as_half.at(0).out_of_range == 1);
    CHECK(write_exr(folder.file("u.exr"), image, {ComponentFormat::uint32}).size() == 3);
}

TEST_CASE("Image: channels that do not belong are refused") {
    Image image = make_image(2, 2);
    add_channel(image, "Y", std::vector<float>(4));
    CHECK_THROWS_AS(add_channel(image, "Y", std::vector<float>(4)), std::invalid_argument);
    CHECK_THROWS_AS(add_channel(image, "", std::vector<float>(4)), std::invalid_argument);
    CHECK_THROWS_AS(add_channel(image, "Z", std::vector<float>(3)), std::invalid_argument);
    CHECK_THROWS_AS(add_rgb_layer(image, "n", std::vector<float>(4)), std::invalid_argument);
    CHECK_THROWS_AS(make_image(0, 1), std::invalid_argument);
    CHECK(image.channels.size() == 1);
    CHECK(layer_of("a.b.R") == "a.b");
    CHECK(layer_of("R").empty());
}

TEST_CASE("EXR: every compression, of which those that lose something lose what is said alone") {
    const TemporaryFolder folder;
    const std::string file = folder.file("a.exr");
    // Uneven and finite, with digits beyond those of a half: what a lossy packing would change.
    Image image = make_image(67, 41);
    std::vector<float> ramp(image.pixel_count());
    for (std::size_t i = 0; i < ramp.size(); i++)
        ramp[i] =
            0.1f + 0.00123f * static_cast<float>(i % 67) + 0.01f * static_cast<float>(i * i % 29);
    for (const char* name : {"R", "normal.Y", "depth.T", "samples.N", "half.R", "half.T"})
        add_channel(image, name, ramp);
    for (std::size_t i = 0; i < exr_compression_names.size(); i++) {
        CAPTURE(exr_compression_names[i]);
        ExrOptions options{.compression = static_cast<ExrCompression>(i)};
        options.layers["half"] = ComponentFormat::float16;
        CHECK(write_exr(file, image, options).empty());
        CHECK(is_written_as(file, options));
        const Image back = read_exr(file);
        std::vector<float> halves;
        halves.reserve(ramp.size());
        for (const float v : ramp)
            halves.push_back(Imath::half(v));
        const auto kept = [&](const char* name, const std::vector<float>& values) {
            return same_bits(find_channel(back, name)->values, values);
        };
        const ExrLoss loss = exr_losses[i];
        CHECK(kept("R", ramp) == (loss != ExrLoss::of_floats && loss != ExrLoss::of_colors));
        CHECK(kept("normal.Y", ramp) == kept("R", ramp));
        CHECK(kept("depth.T", ramp) == (loss != ExrLoss::of_floats));
        CHECK(kept("samples.N", ramp) == kept("depth.T", ramp));
        CHECK(kept("half.R", halves) == (loss != ExrLoss::of_halves && loss != ExrLoss::of_colors));
        CHECK(kept("half.T", halves) == (loss != ExrLoss::of_halves));
    }
}

TEST_CASE("EXR: whether a file is written as asked: its compression, and every component") {
    const TemporaryFolder folder;
    const std::string file = folder.file("a.exr");
    Image image = make_image(2, 2);
    add_channel(image, "R", {1, 2, 3, 4});
    add_channel(image, "a.b.R", {1, 2, 3, 4});
    ExrOptions options;
    CHECK(!is_written_as(file, options)); // there is none
    CHECK(write_exr(file, image, options).empty());
    CHECK(is_written_as(file, options));
    options.compression = ExrCompression::rle;
    CHECK(!is_written_as(file, options));
    options = {};
    options.layers["a.b"] = ComponentFormat::float16;
    CHECK(!is_written_as(file, options));
    CHECK(write_exr(file, image, options).empty());
    CHECK(is_written_as(file, options));
    options.layers[""] = ComponentFormat::float16;
    CHECK(!is_written_as(file, options));
}
