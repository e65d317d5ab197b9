// The pictures of `parhelion compare`: what they show, and what they may not overwrite.
#include "host/commands/compare.h"
#include "host/error.h"
#include "host/image/exr.h"
#include "test_image_tools.h"

#include <filesystem>
#include <sstream>

using namespace parhelion;
using namespace image_test;
using Catch::Contains;

namespace {

/// Two by one pixels.
Image pair_of(float first, float second) {
    Image image = make_image(2, 1);
    add_rgb_layer(image, "", std::vector<float>{first, 0.25f, 0.5f, second, 0.25f, 0.5f});
    return image;
}

struct Pair {
    TemporaryFolder folder;
    CompareOptions options;

    Pair() {
        options.image = folder.file("a.exr"), options.reference = folder.file("b.exr");
        static_cast<void>(write_exr(options.image, pair_of(0.25f, 1.5f)));
        static_cast<void>(write_exr(options.reference, pair_of(0.25f, 0.5f)));
    }
    void run() const {
        std::ostringstream text;
        run_compare(options, text);
    }
};

} // namespace

TEST_CASE("compare: the difference and FLIP are drawn where the images differ") {
    Pair pair;
    pair.options.difference_file = pair.folder.file("difference.exr");
    pair.options.flip_file = pair.folder.file("flip.exr");
    pair.run();
    const Image difference = read_exr(pair.options.difference_file);
    CHECK(find_channel(difference, "R")->values == std::vector<float>{0, 1});
    CHECK(find_channel(difference, "G")->values == std::vector<float>{0, 0});
    const Image flip = read_exr(pair.options.flip_file);
    REQUIRE(flip.channels.size() == 1);
    CHECK(find_channel(flip, "Y")->values[1] > find_channel(flip, "Y")->values[0]);
}

TEST_CASE("compare: a picture overwrites neither a file nor what is compared") {
    Pair pair;
    pair.options.flip_file = pair.folder.file("flip.png");
    pair.run();
    CHECK_THROWS_WITH(pair.run(), Contains("flip.png"));
    pair.options.force = true;
    pair.run();
    pair.options.flip_file = pair.options.reference;
    CHECK_THROWS_AS(pair.run(), InputError);
    CHECK(find_channel(read_exr(pair.options.reference), "R")->values[1] == 0.5f);
    pair.options.flip_file = pair.options.difference_file = pair.folder.file("both.png");
    CHECK_THROWS_AS(pair.run(), InputError);
    pair.options.difference_file.clear();
    pair.options.flip_file = pair.folder.file("flip.jpg");
    CHECK_THROWS_AS(pair.run(), InputError);
}

TEST_CASE("compare: FLIP of what has no colours cannot be drawn") {
    Pair pair;
    Image grey = make_image(2, 1);
    add_channel(grey, "Y", {0.f, 1.f});
    static_cast<void>(write_exr(pair.options.image, grey));
    static_cast<void>(write_exr(pair.options.reference, grey));
    pair.options.flip_file = pair.folder.file("flip.png");
    pair.options.difference_file = pair.folder.file("difference.png");
    CHECK_THROWS_WITH(pair.run(), Contains("--flip-image"));
    CHECK_FALSE(std::filesystem::exists(pair.options.difference_file));
    pair.options.flip_file.clear();
    CHECK_NOTHROW(pair.run());
}
