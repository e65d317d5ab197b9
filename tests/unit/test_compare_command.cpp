// `parhelion compare`: exit codes, what it refuses, the JSON report, Mitsuba's references.
#include "host/commands/compare.h"
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/own_variance.h"
#include "host/image/srgb.h"
#include "test_image_tools.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <tuple>

using namespace parhelion;
using namespace image_test;

namespace {

constexpr int edge = 16;

Image rgb_image(float r, float g, float b) {
    Image image = make_image(edge, edge);
    std::vector<float> pixels;
    for (int i = 0; i < edge * edge; ++i)
        pixels.insert(pixels.end(), {r, g, b});
    add_rgb_layer(image, "", pixels);
    return image;
}

std::string store(const TemporaryFolder& folder, const std::string& name, const Image& image) {
    // Values that are not finite are what some tests are about.
    static_cast<void>(write_exr(folder.file(name), image));
    return folder.file(name);
}

/// Runs the program's command line; nothing is said of what is refused.
int run(std::vector<std::string> arguments) {
    CompareOptions options;
    std::ostringstream text;
    CommandLine command_line;
    command_line.subcommands = {{.name = "compare",
                                 .options = compare_options(options),
                                 .run = [&] { return run_compare(options, text); }}};
    arguments.insert(arguments.begin(), "compare");
    try {
        return run_command_line(command_line, arguments);
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        CHECK(text.str().empty());
        return static_cast<int>(ExitCode::bad_input);
    }
}

std::string text_report(const CompareOptions& options, int expected_code) {
    std::ostringstream out;
    CHECK(run_compare(options, out) == expected_code);
    return out.str();
}

nlohmann::json report(CompareOptions options, int expected_code) {
    options.json = true;
    std::ostringstream out;
    CHECK(run_compare(options, out) == expected_code);
    return nlohmann::json::parse(out.str());
}

CompareOptions compare_options(const std::string& a, const std::string& b) {
    CompareOptions options;
    options.image = a;
    options.reference = b;
    return options;
}

} // namespace

TEST_CASE("compare: exit codes follow the limits") {
    const TemporaryFolder folder;
    const std::string a = store(folder, "a.exr", rgb_image(0.5f, 0.5f, 0.5f));
    const std::string b = store(folder, "b.exr", rgb_image(0.5f, 0.5f, 0.25f));
    CHECK(run({a, b}) == 0);
    CHECK(run({a, a, "--max", "0", "--rmse", "0", "--flip", "0", "--bias", "0"}) == 0);
    // Differences are 0.25 in blue: RMSE and the rest follow.
    CHECK(run({a, b, "--max", "0.25"}) == 0);
    CHECK(run({a, b, "--max", "0.2499"}) == 1);
    CHECK(run({a, b, "--rmse", "0.1444"}) == 0); // 0.25 / sqrt(3) = 0.14434
    CHECK(run({a, b, "--rmse", "0.1443"}) == 1);
    CHECK(run({a, b, "--mae", "0.0834"}) == 0); // 0.25 / 3
    CHECK(run({a, b, "--mae", "0.0833"}) == 1);
    CHECK(run({a, b, "--bias", "1"}) == 0); // 0.25 over 0.25
    CHECK(run({a, b, "--bias", "0.999"}) == 1);
    CHECK(run({b, a, "--bias", "0.5"}) == 0); // 0.25 too little, over 0.5
    CHECK(run({b, a, "--bias", "0.499"}) == 1);
    CHECK(run({a, b, "--relmse", "0.288"}) == 0); // 0.0625 / (0.0625 + 0.01) / 3 = 0.28736
    CHECK(run({a, b, "--relmse", "0.287"}) == 1);
    CHECK(run({a, b, "--relmse", "0.167", "--epsilon", "0.0625"}) == 0); // 1 / 6
    CHECK(run({a, b, "--relmse", "0.166", "--epsilon", "0.0625"}) == 1);
    CHECK(run({a, b, "--flip", "0.9"}) == 0);
    CHECK(run({a, b, "--flip", "0.01"}) == 1);
    CHECK(run({a, b, "--max", "1", "--mae", "0.01"}) == 1);
}

TEST_CASE("compare: what cannot be compared has exit code 2 and one line") {
    const TemporaryFolder folder;
    const std::string a = store(folder, "a.exr", rgb_image(0.5f, 0.5f, 0.5f));
    Image other = make_image(edge, edge + 1);
    add_rgb_layer(other, "", std::vector<float>(3 * edge * (edge + 1)));
    CHECK(run({a, store(folder, "size.exr", other)}) == 2);
    Image moved = rgb_image(0.5f, 0.5f, 0.5f);
    moved.offset_x = 1;
    CHECK(run({a, store(folder, "moved.exr", moved)}) == 2);
    Image depth = make_image(edge, edge);
    add_channel(depth, "depth.T", std::vector<float>(edge * edge));
    const std::string d = store(folder, "depth.exr", depth);
    CHECK(run({a, d}) == 2);
    CHECK(run({a, a, "--layer", "albedo"}) == 2);
    CHECK(run({d, d, "--layer", "depth"}) == 0);
    CHECK(run({d, d, "--layer", "depth", "--flip", "1"}) == 2);
    CHECK(run({a, folder.file("none.exr")}) == 2);
    CHECK(run({a, a, "--max", "nan"}) == 2);
    CHECK(run({a, a, "--rmse", "-1"}) == 2);
    CHECK(run({a, a, "--epsilon", "inf"}) == 2);
    CHECK(run({a, a, "--ppd", "0"}) == 2);
    CHECK(run({a, a, "--variance", a, "--spp", "0"}) == 2);
    CHECK(run({a, a, "--variance", a, "--spp", "4", "--alpha", "1"}) == 2);
    CHECK(run({a}) == 2);
    CHECK(run({a, a, "--variance", a}) == 2); // --variance needs --spp
    CHECK(run({a, a, "--spp", "4"}) == 2);
}

TEST_CASE("compare: values that are not finite") {
    const TemporaryFolder folder;
    const std::string a = store(folder, "a.exr", rgb_image(0.5f, 0.5f, 0.5f));
    Image broken = rgb_image(0.5f, 0.5f, 0.5f);
    broken.channels[1].values[edge + 3] = std::numeric_limits<float>::quiet_NaN();
    const std::string b = store(folder, "b.exr", broken);
    CHECK_THAT(refusal([&] {
                   std::ostringstream out;
                   run_compare(compare_options(b, a), out);
               }),
               Catch::Contains("1 of them not the same in both (first at 3,1 in G)"));
    CHECK(run({a, b, "--max", "1"}) == 2);
    CHECK(run({b, b, "--max", "0"}) == 0);
    CHECK(run({b, b, "--flip", "1"}) == 2); // FLIP is not defined there
    const nlohmann::json same = report(compare_options(b, b), 0);
    CHECK(same.at("non_finite_equal_values") == 1);
    CHECK(same.at("identical") == true);
    CHECK(same.at("flip").is_null());
}

TEST_CASE("compare: the JSON report holds what was measured") {
    const TemporaryFolder folder;
    Image image = rgb_image(0.5f, 0.5f, 0.5f);
    image.channels[2].values[2 * edge + 7] = 1.5f;
    const std::string a = store(folder, "a.exr", image);
    const std::string b = store(folder, "b.exr", rgb_image(0.5f, 0.5f, 0.5f));
    CompareOptions options = compare_options(a, b);
    options.max = 0.5;
    const nlohmann::json json = report(options, 1);
    CHECK(json.at("pass") == false);
    CHECK(json.at("identical") == false);
    CHECK(json.at("width_px") == edge);
    CHECK(json.at("height_px") == edge);
    CHECK(json.at("max_error") ==
          nlohmann::json{{"value", 1.0}, {"channel", "B"}, {"x_px", 7}, {"y_px", 2}});
    CHECK(json.at("channels").size() == 3);
    CHECK(json.at("channels")[2].at("channel") == "B");
    CHECK(json.at("channels")[2].at("mae").get<double>() == Approx(1.0 / 256));
    CHECK(json.at("channels")[2].at("bias_relative").get<double>() == Approx(2.0 / 256));
    CHECK(json.at("all").at("rmse").get<double>() == Approx(std::sqrt(1.0 / 768)));
    CHECK(json.at("relmse_epsilon") == 0.01);
    CHECK(json.at("flip").at("mean").get<double>() > 0.0);
    CHECK(json.at("flip").at("pixels_per_degree").get<double>() == Approx(67.0206).margin(1e-4));
    CHECK(json.at("z_test").is_null());
    CHECK(json.at("limits")[0] ==
          nlohmann::json{{"figure", "max"}, {"limit", 0.5}, {"measured", 1.0}, {"pass", false}});
}

TEST_CASE("compare: alpha and AOV layers") {
    const TemporaryFolder folder;
    Image image = rgb_image(1, 1, 1);
    add_channel(image, "A", std::vector<float>(edge * edge, 1.0f));
    add_channel(image, "Z", std::vector<float>(edge * edge, 9.0f));
    add_rgb_layer(image, "albedo", std::vector<float>(3 * edge * edge, 0.5f));
    Image other = image;
    other.channels[5].values[0] = 0.0f; // albedo.R
    other.channels[4].values[0] = 0.0f; // Z, no colour
    const std::string a = store(folder, "a.exr", image), b = store(folder, "b.exr", other);
    const nlohmann::json main = report(compare_options(a, b), 1);
    CHECK(main.at("identical") == false);
    CHECK(main.at("channels").size() == 4);
    CHECK(main.at("max_error").at("value") == 0.0);
    CHECK(main.at("other_channels").size() == 4); // Z, albedo.R, albedo.G, albedo.B
    CompareOptions options = compare_options(a, b);
    options.figures.layer = "albedo";
    const nlohmann::json layer = report(options, 0);
    CHECK(layer.at("max_error").at("channel") == "albedo.R");
    CHECK(layer.at("max_error").at("value") == 0.5);
    CHECK(!layer.at("flip").is_null());
}

TEST_CASE("compare: a channel that one image lacks is a difference") {
    const TemporaryFolder folder;
    Image rgb = rgb_image(1, 2, 3), rg = rgb, rgba = rgb, layers = rgb;
    rg.channels.pop_back();
    add_channel(rgba, "A", std::vector<float>(edge * edge, 1.0f));
    add_channel(layers, "depth.T", std::vector<float>(edge * edge, 1.0f));
    const std::string full = store(folder, "rgb.exr", rgb);
    for (const auto& [name, image, missing] :
         {std::tuple{"rg.exr", &rg, "B"}, std::tuple{"rgba.exr", &rgba, "A"},
          std::tuple{"layers.exr", &layers, "depth.T"}}) {
        const std::string other = store(folder, name, *image);
        for (const auto& [a, b] : {std::pair{full, other}, std::pair{other, full}}) {
            CHECK(run({a, b}) == 1);
            CHECK(run({a, b, "--rmse", "1"}) == 1);
            CHECK(run({a, b, "--common"}) == 0);
            CHECK(run({a, b, "--common", "--max", "0"}) == 0);
            const bool first_has_it = (a == full) == (image == &rg);
            const nlohmann::json json = report(compare_options(a, b), 1);
            CHECK(json.at("identical") == false);
            CHECK(json.at("pass") == false);
            CHECK(json.at(first_has_it ? "only_in_image" : "only_in_reference") ==
                  nlohmann::json{missing});
            CHECK(json.at(first_has_it ? "only_in_reference" : "only_in_image").empty());
            const std::string text = text_report(compare_options(a, b), 1);
            CHECK_THAT(text, !Catch::Contains("the same"));
            CHECK_THAT(text, Catch::Contains(first_has_it ? "only in A" : "only in B"));
        }
        CHECK(run({other, other, "--max", "0"}) == 0);
    }
}

TEST_CASE("compare: layers that both images have are compared, and others are named") {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image image = rgb_image(1, 1, 1);
    add_rgb_layer(image, "albedo", std::vector<float>(3 * edge * edge, 0.5f));
    add_channel(image, "depth.T", std::vector<float>(edge * edge, nan)); // nowhere anything
    Image other = image;
    const std::string a = store(folder, "a.exr", image);
    CHECK(run({a, a}) == 0);
    CHECK(report(compare_options(a, a), 0).at("identical") == true);
    CHECK_THAT(text_report(compare_options(a, a), 0), Catch::Contains("every value is the same"));
    other.channels[4].values[2 * edge + 3] = 0.25f; // albedo.G
    const std::string b = store(folder, "b.exr", other);
    CHECK(run({a, b}) == 1);
    CHECK(run({a, b, "--max", "0.2499"}) == 1);
    CHECK(run({a, b, "--layer", "depth"}) == 2); // no finite value
    const std::string text = text_report(compare_options(a, b), 1);
    CHECK_THAT(text, !Catch::Contains("every value"));
    CHECK_THAT(text, Catch::Contains("1 values differ, largest error 0.25 at 3,2"));
    // Where the figures show a difference themselves, limits judge them.
    other.channels[0].values[0] = 1.5f; // R
    const std::string c = store(folder, "c.exr", other);
    CHECK(run({a, c}) == 0);
    CHECK(run({a, c, "--max", "0.5"}) == 0);
    CHECK(run({a, c, "--max", "0.4999"}) == 1);
    other.channels[5].values[0] = 2.5f; // albedo.B
    const std::string d = store(folder, "d.exr", other);
    CHECK(run({a, d, "--max", "0.5"}) == 1);
    CHECK(run({a, d, "--max", "2"}) == 0);
    CHECK(run({a, d, "--rmse", "0.1"}) == 0);
    other.channels[6].values[0] = 0.0f; // depth.T: a number in the place of a NaN
    const std::string e = store(folder, "e.exr", other);
    CHECK(run({a, e, "--max", "1e30"}) == 1);
    CompareOptions layer = compare_options(a, e);
    layer.figures.layer = "albedo";
    const nlohmann::json alone = report(layer, 0);
    CHECK(alone.at("not_compared") == nlohmann::json{"B", "G", "R", "depth.T"});
    CHECK(alone.at("other_channels").empty());
}

TEST_CASE("compare: layers that the z-test takes its variances from are no images to compare") {
    const TemporaryFolder folder;
    Image image = rgb_image(1, 1, 1), truth = image;
    add_rgb_layer(image, "variance", std::vector<float>(3 * edge * edge, 0.5f));
    add_channel(image, "samples.N", std::vector<float>(edge * edge, 16.0f));
    const std::string a = store(folder, "a.exr", image), b = store(folder, "b.exr", truth);
    CHECK(run({a, b, "--variance", "own"}) == 0);
    CHECK(run({a, b}) == 1);
    add_channel(image, "depth.T", std::vector<float>(edge * edge, 1.0f));
    CHECK(run({store(folder, "c.exr", image), b, "--variance", "own"}) == 1);
}

TEST_CASE("compare: the z-tests decide the exit code") {
    const TemporaryFolder folder;
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    const Image truth = rgb_image(1, 2, 3);
    Image noisy = truth, biased = truth;
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < edge * edge; ++i) {
            noisy.channels[c].values[i] += normal(random) * 0.02f; // 0.2 / sqrt(100)
            biased.channels[c].values[i] = noisy.channels[c].values[i] + 0.01f;
        }
    const std::string a = store(folder, "a.exr", noisy), b = store(folder, "b.exr", biased);
    const std::string r = store(folder, "r.exr", truth);
    const std::string v = store(folder, "v.exr", rgb_image(0.04f, 0.04f, 0.04f));
    CHECK(run({a, r, "--variance", v, "--spp", "100"}) == 0);
    CHECK(run({a, r, "--variance", v, "--spp", "10000"}) == 1);
    CHECK(run({b, r, "--variance", v, "--spp", "100"}) == 1);
    CHECK(run({a, r, "--variance", v, "--spp", "100", "--max", "0"}) == 1);
    Image small = make_image(1, 1);
    add_rgb_layer(small, "", std::vector<float>(3));
    CHECK(run({a, r, "--variance", store(folder, "small.exr", small), "--spp", "100"}) == 2);
    const std::string negative = store(folder, "n.exr", rgb_image(0.04f, -0.04f, 0.04f));
    CHECK(run({a, r, "--variance", negative, "--spp", "100"}) == 2);

    CompareOptions options = compare_options(b, r);
    options.variance = v;
    options.samples = 100;
    const nlohmann::json json = report(options, 1).at("z_test");
    CHECK(json.at("pixels").at("pass") == true); // blind to this bias
    CHECK(json.at("mean").at("pass") == false);
    CHECK(json.at("mean").at("channels")[0].at("standard_error").get<double>() ==
          Approx(0.02 / 16).epsilon(1e-6));
}

TEST_CASE("compare: an image's own variance and samples") {
    const TemporaryFolder folder;
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    const std::string components[] = {"R", "G", "B"};
    const Image truth = rgb_image(1, 2, 3);
    const auto noisy = [&](float samples, float bias) {
        Image image = truth;
        for (int c = 0; c < 3; ++c)
            for (float& value : image.channels[c].values)
                value += bias + normal(random) * 0.2f / std::sqrt(samples);
        for (const std::string& component : components)
            add_channel(image, "variance." + component, std::vector(edge * edge, 0.04f));
        add_channel(image, "samples.N", std::vector(edge * edge, samples));
        return image;
    };
    const std::string a = store(folder, "a.exr", noisy(100, 0)),
                      b = store(folder, "b.exr", noisy(100, 0.01f)),
                      few = store(folder, "few.exr", noisy(4, 0.f)),
                      one = store(folder, "one.exr", noisy(1, 0.f)),
                      r = store(folder, "r.exr", truth);
    CHECK(run({a, r, "--variance", "own"}) == 0);
    CHECK(run({b, r, "--variance", "own"}) == 1);
    CHECK(run({few, r, "--variance", "own"}) == 0);
    CHECK(run({a, few, "--variance", "own"}) == 0); // B's counts as well
    CHECK(run({r, a, "--variance", "own"}) == 2);   // has none
    CHECK(run({one, r, "--variance", "own"}) == 2);
    CHECK(run({a, one, "--variance", "own"}) == 2);
    CHECK(run({a, r, "--variance", "own", "--spp", "100"}) == 2);
    CHECK(run({a, r, "--variance", "own", "--reference-spp", "100"}) == 2);

    CompareOptions options = compare_options(a, few);
    options.variance = own_variance;
    const nlohmann::json json = report(options, 0).at("z_test");
    CHECK(json.at("own_variance") == true);
    CHECK(json.at("mean").at("channels")[0].at("standard_error").get<double>() ==
          Approx(0.2 * std::sqrt(1. / 100 + 1. / 4) / edge).epsilon(1e-6));
}

TEST_CASE("compare: Mitsuba's references pass with noise of their own variance and not without") {
    const std::string data = data_folder("mitsuba-tests/tests/scenes/bsdf_spheres/refs");
    if (data.empty()) return;
    const TemporaryFolder folder;
    const std::string reference = data + "/test_constant_ref_rgb.exr";
    const std::string variance = data + "/test_constant_ref_rgb_var.exr";
    const Image mean_image = read_exr(reference), variance_image = read_exr(variance);
    const double samples = 2000000 / static_cast<double>(mean_image.pixel_count());
    const Matrix3 to_xyz = inverse(xyz_to_srgb);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto noisy = [&](double factor) {
        Image image = mean_image;
        const auto value = [&](const Image& from, const char* name, std::size_t i) {
            return double(find_channel(from, name)->values[i]);
        };
        for (std::size_t i = 0; i < image.pixel_count(); ++i) {
            auto xyz = transform(to_xyz, {value(mean_image, "R", i), value(mean_image, "G", i),
                                          value(mean_image, "B", i)});
            const auto spread =
                transform(to_xyz, {value(variance_image, "R", i), value(variance_image, "G", i),
                                   value(variance_image, "B", i)});
            for (int c = 0; c < 3; ++c)
                if (spread[c] > 0.0)
                    xyz[c] += factor * normal(random) * std::sqrt(spread[c] / samples);
            const auto rgb = transform(xyz_to_srgb, xyz);
            for (Channel& channel : image.channels)
                for (int c = 0; c < 3; ++c)
                    if (channel.name == std::string(1, "RGB"[c]))
                        channel.values[i] = static_cast<float>(rgb[c]);
        }
        return image;
    };
    const std::string good = store(folder, "good.exr", noisy(1.0));
    const std::string bad = store(folder, "bad.exr", noisy(2.0));
    const std::string spp = std::to_string(samples);
    CHECK(run({good, reference, "--variance", variance, "--spp", spp, "--xyz-statistics"}) == 0);
    CHECK(run({bad, reference, "--variance", variance, "--spp", spp, "--xyz-statistics"}) == 1);
}
