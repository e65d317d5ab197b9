// Images as textures read them: every format against the values that its file was made of.
#include "host/error.h"
#include "host/image/texels.h"
#include "tests/support/image_files.h"

#include <catch2/catch.hpp>

#include <cstring>

#include <zlib.h>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Contains;

namespace {

struct Texels {
    TexelLayout layout;
    std::vector<std::byte> bytes;

    template<class T>
    T at(std::size_t component) const {
        T value;
        std::memcpy(&value, &bytes.at(component * sizeof(T)), sizeof(T));
        return value;
    }
};

Texels texels_of(const std::string& file, const std::string& name) {
    Texels t{layout_of_texels(file, name), {}};
    t.bytes.resize(t.layout.bytes());
    parse_texels(file, name, t.layout, t.bytes);
    return t;
}

std::string refusal(const std::string& file, const std::string& name = "broken") {
    try {
        texels_of(file, name);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TexelLayout bytes_layout(const TestImage& image) {
    return {image.width, image.height, 3, TexelComponent::byte, true};
}

void check_bytes(const std::string& file, const std::string& name, const TestImage& image) {
    INFO(name);
    Texels t = texels_of(file, name);
    CHECK(t.layout == bytes_layout(image));
    REQUIRE(t.bytes.size() == image.rgb.size());
    CHECK(std::memcmp(t.bytes.data(), image.rgb.data(), image.rgb.size()) == 0);
}

/// With another width and height in its header, whose check sum is right.
std::string png_that_claims(std::string file, int side) {
    const char bytes[] = {static_cast<char>(side >> 24), static_cast<char>(side >> 16),
                          static_cast<char>(side >> 8), static_cast<char>(side)};
    file.replace(16, 8, std::string(bytes, 4) + std::string(bytes, 4));
    auto sum = crc32(0, reinterpret_cast<const Bytef*>(file.data()) + 12, 17);
    for (int k = 0; k < 4; k++)
        file[29 + k] = static_cast<char>(sum >> 8 * (3 - k));
    return file;
}

const std::vector<float> six_floats{0.f, 1.f, 2.5f, -3.f, 1e-3f, 7e4f};

} // namespace

TEST_CASE("texels: formats of bytes give the bytes they were made of") {
    TestImage image = six_colors();
    check_bytes(png_of(image), "a.png", image);
    check_bytes(bmp_of(image), "a.bmp", image);
    check_bytes(palette_bmp_of(image), "palette.bmp", image);
    for (bool runs : {false, true})
        for (bool from_top : {false, true})
            check_bytes(tga_of(image, runs, from_top), "a.TGA", image);
}

TEST_CASE("texels: a run of a TGA file is one colour") {
    Texels t = texels_of(tga_run(5, {10, 20, 30}), "run.tga");
    CHECK(t.layout == TexelLayout{5, 1, 3, TexelComponent::byte, true});
    for (std::size_t k = 0; k < 15; k++)
        CHECK(t.at<std::uint8_t>(k) == 10 * (k % 3 + 1));
}

TEST_CASE("texels: PNG with alpha keeps its colours, grey is one component, 16 bits are floats") {
    const std::uint8_t rgba[] = {200, 100, 50, 0, 10, 20, 30, 128};
    Texels t = texels_of(png_of(2, 1, PNG_FORMAT_RGBA, rgba), "a.png");
    CHECK(t.layout == TexelLayout{2, 1, 3, TexelComponent::byte, true});
    const int expected[] = {200, 100, 50, 10, 20, 30};
    for (std::size_t k = 0; k < 6; k++)
        CHECK(t.at<std::uint8_t>(k) == expected[k]);

    const std::uint8_t grey[] = {7, 250};
    t = texels_of(png_of(2, 1, PNG_FORMAT_GRAY, grey), "a.png");
    CHECK(t.layout == TexelLayout{2, 1, 1, TexelComponent::byte, true});
    CHECK(t.at<std::uint8_t>(1) == 250);

    const std::uint16_t wide[] = {0, 1, 1000, 65535, 258, 32768};
    t = texels_of(png_of(2, 1, PNG_FORMAT_LINEAR_RGB, wide), "a.png");
    CHECK(t.layout == TexelLayout{2, 1, 3, TexelComponent::single, true});
    for (std::size_t k = 0; k < 6; k++)
        CHECK(t.at<float>(k) == static_cast<float>(wide[k] / 65535.0));
}

TEST_CASE("texels: JPEG keeps one colour to two levels, and grey as grey") {
    Texels t = texels_of(jpeg_of(19, 11, {200, 100, 50}), "a.jpg");
    CHECK(t.layout == TexelLayout{19, 11, 3, TexelComponent::byte, true});
    const int expected[] = {200, 100, 50};
    for (std::size_t k = 0; k < t.bytes.size(); k++)
        CHECK(std::abs(t.at<std::uint8_t>(k) - expected[k % 3]) <= 2);
    t = texels_of(jpeg_of(9, 9, {77}), "a.jpg");
    CHECK(t.layout == TexelLayout{9, 9, 1, TexelComponent::byte, true});
    CHECK(t.at<std::uint8_t>(80) == 77);
}

TEST_CASE("texels: OpenEXR stays half, floats stay floats") {
    const std::vector<float> halves{0.f, 1.f, 2.5f, -3.f, 0.125f, 1024.f};
    Texels t = texels_of(exr_of(2, 1, {"R", "G", "B"}, halves, ComponentFormat::float16), "a.exr");
    CHECK(t.layout == TexelLayout{2, 1, 3, TexelComponent::half, false});
    const int bits[] = {0x0000, 0x3c00, 0x4100, 0xc200, 0x3000, 0x6400}; // IEEE 754 binary16
    for (std::size_t k = 0; k < 6; k++)
        CHECK(t.at<std::uint16_t>(k) == bits[k]);
    t = texels_of(exr_of(1, 2, {"R", "G", "B"}, six_floats, ComponentFormat::float32), "a.exr");
    CHECK(t.layout == TexelLayout{1, 2, 3, TexelComponent::single, false});
    for (std::size_t k = 0; k < 6; k++)
        CHECK(t.at<float>(k) == six_floats[k]);
    t = texels_of(exr_of(6, 1, {"Y"}, six_floats, ComponentFormat::float32), "a.exr");
    CHECK(t.layout == TexelLayout{6, 1, 1, TexelComponent::single, false});
    CHECK_THAT(refusal(exr_of(6, 1, {"Z"}, six_floats, ComponentFormat::float32)),
               Contains("channels Z (accepted: R, G, B; or Y)"));
}

TEST_CASE("texels: Radiance HDR, plain and in runs") {
    // Ward's numbers: mantissa / 256 times two to the exponent less 128.
    const std::vector<std::array<int, 4>> plain{{128, 64, 0, 129}, {255, 1, 2, 120}};
    Texels t = texels_of(rgbe_of(1, 2, plain, false), "a.hdr");
    CHECK(t.layout == TexelLayout{1, 2, 3, TexelComponent::single, false});
    const double expected[] = {1, 0.5, 0, 255 * 0x1p-16, 0x1p-16, 0x1p-15};
    for (std::size_t k = 0; k < 6; k++)
        CHECK(double{t.at<float>(k)} == expected[k]);

    std::vector<std::array<int, 4>> row(9, {100, 50, 25, 130});
    row[0] = {1, 2, 3, 128};
    row[8] = {200, 100, 50, 131};
    t = texels_of(rgbe_of(9, 1, row, true), "a.hdr");
    for (std::size_t x = 0; x < 9; x++)
        for (std::size_t c = 0; c < 3; c++)
            CHECK(double{t.at<float>(3 * x + c)} == std::ldexp(row[x][c], row[x][3] - 136));
}

TEST_CASE("texels: PFM has its bottom row first, of either order of bytes") {
    Texels t = texels_of(pfm_of(1, 2, six_floats, 3), "a.pfm");
    CHECK(t.layout == TexelLayout{1, 2, 3, TexelComponent::single, false});
    for (std::size_t k = 0; k < 6; k++)
        CHECK(t.at<float>(k) == six_floats[k]);
    std::string big = "Pf\n1 1\n2.0\n";
    add_bytes(big, {0x3f, 0xc0, 0, 0}); // 1.5
    t = texels_of(big, "a.pfm");
    CHECK(t.layout == TexelLayout{1, 1, 1, TexelComponent::single, false});
    CHECK(t.at<float>(0) == 3.f);
}

TEST_CASE("texels: a file cut short is refused with one line that names it") {
    const std::vector<std::array<int, 4>> rgbe(6, {128, 64, 32, 129});
    TestImage image = six_colors();
    const std::pair<const char*, std::string> files[] = {
        {"a.png", png_of(image)},
        {"a.bmp", bmp_of(image)},
        {"a.tga", tga_of(image, true, true)},
        {"b.tga", tga_of(image, false, false)},
        {"a.jpg", jpeg_of(64, 64, {200, 100, 50})},
        {"a.exr", exr_of(1, 2, {"R", "G", "B"}, six_floats, ComponentFormat::float32)},
        {"a.hdr", rgbe_of(3, 2, rgbe, false)},
        {"a.pfm", pfm_of(1, 2, six_floats, 3)}};
    for (const auto& [name, file] : files) {
        CHECK(refusal(file, name).empty());
        for (std::size_t left : {file.size() - 2, file.size() / 2, std::size_t{12}}) {
            std::string said = refusal(file.substr(0, left), name);
            INFO(name << " cut to " << left << ": " << said);
            CHECK(said.rfind(std::string(name) + ": ", 0) == 0);
            CHECK(said.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("texels: sizes are refused before memory is taken") {
    const std::string small = png_of(six_colors());
    CHECK_THAT(refusal(png_that_claims(small, 2000000000)),
               Contains("2000000000 x 2000000000 texels (accepted"));
    CHECK_THAT(refusal(png_that_claims(small, 60000)),
               Contains("broken: 60000 x 60000 texels (accepted: sides of 1 to"));
    CHECK_THAT(refusal(png_that_claims(small, 15000)),
               Contains("15000 x 15000 texels are too many for"));
    CHECK_THAT(refusal("PF\n60000 60000\n-1\n"), Contains("60000 x 60000 texels"));
    CHECK_THAT(refusal("#?RADIANCE\n\n-Y 0 +X 5\n"), Contains("5 x 0 texels"));
}

TEST_CASE("texels: what is no image is refused, and says what is read") {
    CHECK_THAT(refusal("GIF89a and so on"),
               Contains("not an image of a known format (accepted: PNG, JPEG, OpenEXR, "
                        "Radiance HDR, BMP, PFM, TGA)"));
    CHECK_THAT(refusal(""), Contains("not an image"));
    CHECK_THROWS_WITH(open_texels("/nowhere/a.png"), Contains("/nowhere/a.png: cannot be read"));
}
