// Reading EXR files of unknown origin: a right image or one clear line, never a crash.
#include "host/image/exr.h"
#include "test_image_tools.h"

#include <ImfChannelList.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTiledRgbaFile.h>

#include <cmath>
#include <cstring>
#include <random>

using namespace parhelion;
using namespace image_test;

namespace {

/// Reads; returns false for a refusal in one line. Anything else thrown fails the test.
bool readable(const std::string& file) {
    try {
        const Image image = read_exr(file);
        for (const Channel& channel : image.channels)
            CHECK(channel.values.size() == image.pixel_count());
        CHECK(!image.channels.empty());
        return true;
    } catch (const InputError& error) {
        const std::string message = error.what();
        INFO(message);
        CHECK(message.rfind(file, 0) == 0);
        CHECK(message.find('\n') == std::string::npos);
        return false;
    }
}

std::string small_file(const TemporaryFolder& folder) {
    Image image = make_image(8, 6);
    add_rgb_layer(image, "", std::vector<float>(8 * 6 * 3, 0.25f));
    image.metadata = {{"comments", std::string("x")}};
    const std::string file = folder.file("small.exr");
    CHECK(write_exr(file, image).empty());
    return file;
}

/// Place of an attribute's value in the bytes of a file.
std::size_t value_of(const std::vector<char>& bytes, const std::string& name,
                     const std::string& type) {
    const std::string key = name + '\0' + type + '\0';
    const auto at = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
    REQUIRE(at != bytes.end());
    return static_cast<std::size_t>(at - bytes.begin()) + key.size() + 4;
}

} // namespace

TEST_CASE("EXR reading: what is no EXR file is refused by name") {
    const TemporaryFolder folder;
    CHECK_THAT(refusal([&] { read_exr(folder.file("none.exr")); }),
               Catch::Contains("no such file"));
    CHECK_THAT(refusal([&] { read_exr(folder.name()); }), Catch::Contains("not a regular file"));
    write_bytes(folder.file("empty.exr"), {});
    CHECK_THAT(refusal([&] { read_exr(folder.file("empty.exr")); }),
               Catch::Contains("not an OpenEXR file"));
    write_bytes(folder.file("picture.png"), {'\x89', 'P', 'N', 'G', '\r', '\n', '\x1a', '\n'});
    CHECK_THAT(refusal([&] { read_exr(folder.file("picture.png")); }),
               Catch::Contains("not an OpenEXR file"));
}

TEST_CASE("EXR reading: a file cut off anywhere is refused") {
    const TemporaryFolder folder;
    const std::vector<char> bytes = read_bytes(small_file(folder));
    REQUIRE(bytes.size() > 300);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const std::string file = folder.file("cut.exr");
        write_bytes(file, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
        INFO("cut to " << length << " of " << bytes.size());
        CHECK_FALSE(readable(file));
    }
}

TEST_CASE("EXR reading: any byte may be wrong") {
    const TemporaryFolder folder;
    const std::vector<char> bytes = read_bytes(small_file(folder));
    std::size_t refused = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (const char flip : {'\x01', '\x40', '\x80', '\xff'}) {
            std::vector<char> damaged = bytes;
            damaged[i] = static_cast<char>(damaged[i] ^ flip);
            write_bytes(folder.file("damaged.exr"), damaged);
            refused += !readable(folder.file("damaged.exr"));
        }
    }
    CHECK(refused > bytes.size()); // most damage must show
}

TEST_CASE("EXR reading: absurd windows are refused before memory is asked for") {
    const TemporaryFolder folder;
    const std::vector<char> bytes = read_bytes(small_file(folder));
    const std::size_t at = value_of(bytes, "dataWindow", "box2i");
    const auto with_window = [&](std::int32_t x0, std::int32_t y0, std::int32_t x1,
                                 std::int32_t y1) {
        std::vector<char> changed = bytes;
        const std::array<std::int32_t, 4> window{x0, y0, x1, y1};
        std::memcpy(changed.data() + at, window.data(), sizeof window);
        write_bytes(folder.file("window.exr"), changed);
        return refusal([&] { read_exr(folder.file("window.exr")); });
    };
    CHECK_THAT(with_window(0, 0, 1 << 20, 5), Catch::Contains("window"));
    with_window(0, 0, 99999, 99999);
    with_window(0, 0, 1 << 30, 1 << 30);
    with_window(0, 0, 0x7fffffff, 0x7fffffff);
    with_window(-0x7fffffff - 1, -0x7fffffff - 1, 0x7fffffff, 0x7fffffff);
    with_window(5, 5, 4, 4);
    with_window(0, 0, 7, 9999); // rows the file does not have
    CHECK_THAT(with_window(0, 0, 69999, 5), Catch::Contains("too large for"));
}

TEST_CASE("EXR reading: tiles, half and a decreasing line order give the right pixels") {
    const TemporaryFolder folder;
    const int width = 70, height = 50;
    std::vector<Imf::Rgba> pixels(width * height);
    for (int i = 0; i < width * height; ++i)
        pixels[i] = {0.5f * i, -1.0f * i, i % 7 * 0.125f, 1};
    const std::string tiled = folder.file("tiled.exr"), lines = folder.file("lines.exr");
    {
        Imf::TiledRgbaOutputFile output(tiled.c_str(), width, height, 16, 16, Imf::MIPMAP_LEVELS);
        output.setFrameBuffer(pixels.data(), 1, width);
        output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
        for (int level = 1; level < output.numLevels(); ++level)
            output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1,
                              level);
    }
    {
        Imf::RgbaOutputFile output(lines.c_str(), width, height, Imf::WRITE_RGBA, 1,
                                   Imath::V2f(0, 0), 1, Imf::DECREASING_Y, Imf::PIZ_COMPRESSION);
        output.setFrameBuffer(pixels.data(), 1, width);
        output.writePixels(height);
    }
    for (const std::string& file : {tiled, lines}) {
        const Image image = read_exr(file);
        REQUIRE(image.width == width);
        REQUIRE(image.height == height);
        std::size_t wrong = 0;
        for (int i = 0; i < width * height; ++i)
            wrong += find_channel(image, "R")->values[i] != float(pixels[i].r) ||
                     find_channel(image, "G")->values[i] != float(pixels[i].g) ||
                     find_channel(image, "B")->values[i] != float(pixels[i].b);
        CHECK(wrong == 0);
    }
}

TEST_CASE("EXR reading: luminance and chroma become R G B") {
    const TemporaryFolder folder;
    const std::string file = folder.file("yc.exr");
    const int edge = 32;
    const std::vector<Imf::Rgba> pixels(edge * edge, Imf::Rgba(0.75f, 0.5f, 0.25f, 1));
    {
        Imf::RgbaOutputFile output(file.c_str(), edge, edge, Imf::WRITE_YC);
        output.setFrameBuffer(pixels.data(), 1, edge);
        output.writePixels(edge);
    }
    const Image image = read_exr(file);
    REQUIRE(image.channels.size() == 3);
    for (const float value : find_channel(image, "R")->values)
        CHECK(value == Approx(0.75).epsilon(2e-3));
    for (const float value : find_channel(image, "B")->values)
        CHECK(value == Approx(0.25).epsilon(6e-3));
}

TEST_CASE(
    "EXR reading: parts become layers; windows that differ, deep data and subsampling are named") {
    const TemporaryFolder folder;
    const auto write_parts = [&](const std::string& file, int second_width) {
        std::vector<Imf::Header> headers{Imf::Header(4, 2), Imf::Header(second_width, 2)};
        for (int part = 0; part < 2; ++part) {
            headers[part].setName(part == 0 ? "beauty" : "albedo");
            headers[part].setType(Imf::SCANLINEIMAGE);
            headers[part].channels().insert("R", Imf::Channel(Imf::FLOAT));
        }
        headers[0].displayWindow() = headers[1].displayWindow(); // shared by all parts
        Imf::MultiPartOutputFile output(file.c_str(), headers.data(), 2);
        for (int part = 0; part < 2; ++part) {
            const int width = part == 0 ? 4 : second_width;
            std::vector<float> values(2 * width, part + 0.5f);
            Imf::FrameBuffer frame;
            frame.insert("R",
                         Imf::Slice::Make(Imf::FLOAT, values.data(), Imath::V2i(0, 0), width, 2));
            Imf::OutputPart output_part(output, part);
            output_part.setFrameBuffer(frame);
            output_part.writePixels(2);
        }
    };
    write_parts(folder.file("parts.exr"), 4);
    const Image image = read_exr(folder.file("parts.exr"));
    REQUIRE(find_channel(image, "beauty.R"));
    REQUIRE(find_channel(image, "albedo.R"));
    CHECK(find_channel(image, "beauty.R")->values == std::vector<float>(8, 0.5f));
    CHECK(find_channel(image, "albedo.R")->values == std::vector<float>(8, 1.5f));
    write_parts(folder.file("differ.exr"), 5);
    CHECK_THAT(refusal([&] { read_exr(folder.file("differ.exr")); }),
               Catch::Contains("part 1: windows"));

    {
        Imf::Header header(3, 2);
        header.setType(Imf::DEEPSCANLINE);
        header.compression() = Imf::ZIPS_COMPRESSION;
        header.channels().insert("R", Imf::Channel(Imf::FLOAT));
        const Imf::DeepScanLineOutputFile output(folder.file("deep.exr").c_str(), header);
    }
    CHECK_THAT(refusal([&] { read_exr(folder.file("deep.exr")); }), Catch::Contains("deep data"));

    {
        Imf::Header header(4, 4);
        header.channels().insert("U", Imf::Channel(Imf::FLOAT, 2, 2));
        std::vector<float> values(4, 1.0f);
        Imf::FrameBuffer frame;
        frame.insert("U",
                     Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8, 2, 2));
        Imf::OutputFile output(folder.file("sub.exr").c_str(), header);
        output.setFrameBuffer(frame);
        output.writePixels(4);
    }
    CHECK_THAT(refusal([&] { read_exr(folder.file("sub.exr")); }),
               Catch::Contains("channel U is subsampled"));
}

TEST_CASE("EXR reading: every damaged file of the shared data is refused or read") {
    const std::string folder = data_folder("bad-input/exr");
    if (folder.empty()) return;
    std::size_t refused = 0;
    const auto files = files_below(folder, ".exr");
    REQUIRE(!files.empty());
    for (const std::string& file : files)
        refused += !readable(file);
    CHECK(refused >= 9); // the others are whole but for a type attribute that a reader may ignore
}

TEST_CASE("EXR reading: the good files of the shared data are read") {
    const std::string folder = data_folder("images/exr");
    if (folder.empty()) return;
    for (const std::string& file : files_below(folder, ".exr")) {
        INFO(file);
        const bool truncated = file.ends_with("/exr/tiled.exr"); // 480 of some 2300 bytes
        CHECK(readable(file) == !truncated);
    }
    const Image halves = read_exr(folder + "/TestImages/AllHalfValues.exr");
    std::size_t not_finite = 0;
    for (const float value : find_channel(halves, "R")->values)
        not_finite += !std::isfinite(value);
    CHECK(halves.pixel_count() == 65536);
    CHECK(not_finite == 2048); // two infinities and 2046 NaN
}

TEST_CASE("EXR reading: Mitsuba's references are read and finite") {
    const std::string folder = data_folder("mitsuba-tests/tests/scenes");
    if (folder.empty()) return;
    const auto files = files_below(folder, ".exr");
    REQUIRE(!files.empty());
    for (const std::string& file : files) {
        if (file.find("/refs/") == std::string::npos) continue;
        INFO(file);
        const Image image = read_exr(file);
        for (const char* name : {"R", "G", "B"}) {
            REQUIRE(find_channel(image, name));
            const auto& values = find_channel(image, name)->values;
            CHECK(std::all_of(values.begin(), values.end(),
                              [](float v) { return std::isfinite(v); }));
        }
    }
}
