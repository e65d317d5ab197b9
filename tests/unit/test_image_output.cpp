// Outputs: refused before the work, whole or absent after it; the PNG preview's values.
#include "host/image/exr.h"
#include "host/image/output.h"
#include "host/image/png.h"
#include "host/image/png_file.h"
#include "host/image/srgb.h"
#include "test_image_tools.h"

#include <png.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>
#include <sys/resource.h>

using namespace parhelion;
using namespace image_test;

namespace {

/// Lets no file of this process grow beyond a size while it lives: a disk that is full.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_limit_) == 0);
        const rlimit limit{bytes, old_limit_.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit old_limit_{};
    void (*old_handler_)(int);
};

Image noisy_image(int edge) {
    Image image = make_image(edge, edge);
    std::vector<float> values(3 * image.pixel_count());
    std::uint32_t state = 1;
    for (float& value : values) {
        state = state * 1664525u + 1013904223u;
        value = static_cast<float>(state >> 8) * 0x1p-24f;
    }
    add_rgb_layer(image, "", values);
    return image;
}

std::vector<std::uint8_t> decode_png(const std::string& file, int width, int height) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&png, file.c_str()));
    CHECK(static_cast<int>(png.width) == width);
    CHECK(static_cast<int>(png.height) == height);
    png.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(png));
    REQUIRE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr));
    return bytes;
}

} // namespace

TEST_CASE("Output: what could not be written is refused before the work") {
    const TemporaryFolder folder;
    CHECK_NOTHROW(check_output(folder.file("a.exr"), false));
    CHECK_NOTHROW(check_output(folder.file("a.PNG"), false));
    CHECK(image_format("x/y.ExR") == ImageFormat::exr);
    CHECK(image_format("y.png") == ImageFormat::png);
    for (const char* name : {"a.jpg", "a", ".exr", "exr", "a.exr.bak"})
        CHECK_THAT(refusal([&] { check_output(folder.file(name), false); }),
                   Catch::Contains("must end in .exr or .png"));
    CHECK_THAT(refusal([&] { check_output(folder.file("no/a.exr"), true); }),
               Catch::Contains("does not exist"));
    write_bytes(folder.file("old.exr"), {'x'});
    CHECK_THAT(refusal([&] { check_output(folder.file("old.exr"), false); }),
               Catch::Contains("--force"));
    CHECK_NOTHROW(check_output(folder.file("old.exr"), true));
    fs::create_directory(folder.file("folder.exr"));
    CHECK_THAT(refusal([&] { check_output(folder.file("folder.exr"), true); }),
               Catch::Contains("not a regular file"));
    CHECK(folder.entries() == 2);
}

TEST_CASE("Output: a folder without write permission is refused") {
    if (::geteuid() == 0) {
        parhelion::test::skip("the superuser may write everywhere");
        return;
    }
    const TemporaryFolder folder;
    fs::permissions(folder.name(), fs::perms::owner_read | fs::perms::owner_exec);
    CHECK_THAT(refusal([&] { check_output(folder.file("a.exr"), false); }),
               Catch::Contains("not writable"));
    fs::permissions(folder.name(), fs::perms::owner_all);
}

TEST_CASE("Output: a full disk leaves neither half a file nor a temporary, and keeps the old one") {
    const TemporaryFolder folder;
    const Image image = noisy_image(128);
    for (const std::string name : {"a.exr", "a.png"}) {
        const std::string file = folder.file(name);
        const auto write = [&] {
            return name == "a.exr" ? write_exr(file, image) : write_png(file, image);
        };
        {
            const FullDisk disk(10000);
            CHECK_THAT(refusal<OutputError>(write), Catch::Contains(name + ": cannot write"));
        }
        CHECK_FALSE(fs::exists(file));
        write_bytes(file, {'o', 'l', 'd'});
        {
            const FullDisk disk(10000);
            refusal<OutputError>(write);
        }
        CHECK(read_bytes(file) == std::vector<char>{'o', 'l', 'd'});
        CHECK(folder.entries() == 1);
        CHECK(write().empty());
        CHECK(read_bytes(file).size() > 10000);
        fs::remove(file);
    }
    CHECK(folder.entries() == 0);
}

TEST_CASE("Output: a disk that fills on the last bytes is noticed") {
    const TemporaryFolder folder;
    const Image image = noisy_image(64);
    CHECK(write_exr(folder.file("whole.exr"), image).empty());
    const auto size = fs::file_size(folder.file("whole.exr"));
    for (const rlim_t missing : {1, 5000}) {
        const FullDisk disk(size - missing);
        refusal<OutputError>([&] { return write_exr(folder.file("a.exr"), image); });
    }
    CHECK(folder.entries() == 1);
}

TEST_CASE("Output: a missing folder is an error of the writers as well") {
    const TemporaryFolder folder;
    const Image image = noisy_image(2);
    refusal<OutputError>([&] { return write_exr(folder.file("no/a.exr"), image); });
    refusal<OutputError>([&] { return write_png(folder.file("no/a.png"), image); });
    CHECK(folder.entries() == 0);
}

TEST_CASE("Output: names with a percent sign, spaces and UTF-8 work") {
    const TemporaryFolder folder;
    const std::string file = folder.file("50% déjà vu.exr");
    CHECK(write_exr(file, noisy_image(2)).empty());
    CHECK(read_exr(file).width == 2);
}

TEST_CASE("sRGB: both branches meet and the ends are exact") {
    CHECK(srgb_encode(0.0) == 0.0);
    CHECK(srgb_encode(1.0) == Approx(1.0).epsilon(1e-15));
    CHECK(srgb_encode(0.5) == Approx(0.7353569830524495).epsilon(1e-12));
    CHECK(srgb_encode(0.0031308) == Approx(srgb_encode(0.00313081)).epsilon(1e-4));
    const Matrix3 back = inverse(xyz_to_srgb);
    const auto same = transform(back, transform(xyz_to_srgb, {0.2, 0.5, 0.9}));
    CHECK(same[0] == Approx(0.2).epsilon(1e-13));
    CHECK(same[1] == Approx(0.5).epsilon(1e-13));
    CHECK(same[2] == Approx(0.9).epsilon(1e-13));
}

TEST_CASE("PNG: clipped sRGB, exposure in stops, and pixels that are not finite in magenta") {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    Image image = make_image(4, 1);
    add_rgb_layer(image, "",
                  std::vector<float>{0, 0.5f, 1, -1, 0.25f, 7, nan, 0, 0, 0, infinity, 0});
    const std::vector<Misfits> misfits = write_png(folder.file("a.png"), image);
    REQUIRE(misfits.size() == 2);
    CHECK((misfits[0].channel == "R" && misfits[0].not_finite == 1 && misfits[0].x == 2));
    CHECK((misfits[1].channel == "G" && misfits[1].not_finite == 1 && misfits[1].x == 3));
    // 255 srgb(0.5) = 187.5 (to 187.516), 255 srgb(0.25) = 136.95
    CHECK(decode_png(folder.file("a.png"), 4, 1) ==
          std::vector<std::uint8_t>{0, 188, 255, 0, 137, 255, 255, 0, 255, 255, 0, 255});
    CHECK(misfit_count(write_png(folder.file("a.png"), image, 1.0)) == 2);
    CHECK(decode_png(folder.file("a.png"), 4, 1) ==
          std::vector<std::uint8_t>{0, 255, 255, 0, 188, 255, 255, 0, 255, 255, 0, 255});
    CHECK(folder.entries() == 1);
}

TEST_CASE("PNG: metadata are texts of the file, without a say in its pixels") {
    const TemporaryFolder folder;
    Image image = make_image(2, 1);
    add_rgb_layer(image, "", std::vector<float>{0, 0.5f, 1, 1, 0.5f, 0});
    CHECK(write_png(folder.file("plain.png"), image).empty());
    image.metadata = {{"scene", std::string("a/ä \u2028.xml")},
                      {"seed", std::int64_t{4294967295}},
                      {"exposure", -1.5},
                      {"notes", std::string("one\ntwo")},
                      {"empty", std::string()}};
    CHECK(write_png(folder.file("told.png"), image).empty());
    CHECK(decode_png(folder.file("told.png"), 2, 1) == decode_png(folder.file("plain.png"), 2, 1));
    CHECK(png_attribute(folder.file("told.png"), "scene") == "a/ä \u2028.xml");
    CHECK(png_attribute(folder.file("told.png"), "seed") == "4294967295");
    CHECK(png_attribute(folder.file("told.png"), "exposure") == "-1.5");
    CHECK(png_attribute(folder.file("told.png"), "notes") == "one\ntwo");
    CHECK(png_attribute(folder.file("told.png"), "Seed").empty());
    CHECK(png_attribute(folder.file("plain.png"), "seed").empty());
    // As the PNG specification has international text: length, type, keyword and its end, no
    // compression, no language, no translated keyword, the text, a checksum.
    const std::vector<char> bytes = read_bytes(folder.file("told.png"));
    const std::string all(bytes.begin(), bytes.end());
    using namespace std::string_literals;
    CHECK_THAT(all, Catch::Contains("\0\0\0\x13iTXtseed\0\0\0\0\0"s + "4294967295"));
    CHECK(all.find("iTXt") < all.find("IDAT"));
    // What is none, or cut off, has no texts.
    write_bytes(folder.file("cut.png"), {bytes.begin(), bytes.begin() + 60});
    CHECK(png_attribute(folder.file("cut.png"), "scene").empty());
    write_bytes(folder.file("none.png"), {'o', 'l', 'd'});
    CHECK(png_attribute(folder.file("none.png"), "scene").empty());
    CHECK(png_attribute(folder.file("missing.png"), "scene").empty());
    CHECK(png_attribute("/", "scene").empty());
}

TEST_CASE("PNG: luminance is grey, XYZ is converted, anything else is refused") {
    const TemporaryFolder folder;
    Image grey = make_image(1, 1);
    add_channel(grey, "Y", {0.5f});
    CHECK(write_png(folder.file("y.png"), grey).empty());
    CHECK(decode_png(folder.file("y.png"), 1, 1) == std::vector<std::uint8_t>{188, 188, 188});
    Image xyz = grey;
    add_channel(xyz, "X", {0.5f * 0.950456f});
    add_channel(xyz, "Z", {0.5f * 1.089058f});
    CHECK(write_png(folder.file("xyz.png"), xyz).empty());
    CHECK(decode_png(folder.file("xyz.png"), 1, 1) == std::vector<std::uint8_t>{188, 188, 188});
    Image depth = make_image(1, 1);
    add_channel(depth, "depth.T", {1.0f});
    CHECK_THAT(refusal([&] { return write_png(folder.file("d.png"), depth); }),
               Catch::Contains("needs channels R G B"));
    CHECK(folder.entries() == 2);
}

TEST_CASE("Output: rows that cannot be made are no fault of the disk, and leave what was there") {
    const TemporaryFolder folder;
    Image frame = make_image(1, 512);
    for (const char* name : {"R", "G", "B"})
        add_channel(frame, name, std::vector<float>(512));
    /// The upper half alone can be read.
    struct Damaged : WholeImage {
        using WholeImage::WholeImage;
        Image rows(int first, int count) const override {
            if (first + count > 256) throw InputError("row 256 is damaged");
            return WholeImage::rows(first, count);
        }
    };
    const Damaged image(frame);
    for (const std::string name : {"a.exr", "a.png"}) {
        write_bytes(folder.file(name), {'o', 'l', 'd'});
        const auto write = [&] {
            return name == "a.exr" ? write_exr(folder.file(name), image)
                                   : write_png(folder.file(name), image);
        };
        CHECK(refusal<InputError>(write) == "row 256 is damaged");
        CHECK(read_bytes(folder.file(name)) == std::vector<char>{'o', 'l', 'd'});
    }
    CHECK(folder.entries() == 2);
}
