// Every number of every plugin, at the ends of its domain, inside and beyond: refused with one
// line, mapped with a note, or an image that is right.
#include "host/flatten/kind_names.h"
#include "host/flatten/material_records.h"
#include "host/render/host_render.h"
#include "host/scene/text.h"
#include "test_scene_tools.h"
#include "tests/support/domain_scenes.h"
#include "tests/support/domain_values.h"
#include "tests/support/image_files.h"

#include <algorithm>
#include <limits>
#include <numbers>

using namespace parhelion;
using namespace parhelion::test;

namespace {

struct Outcome {
    std::string refusal; ///< empty: loaded
    Scene scene;
};

/// Where scenes stand, beside an image of 1.
const SceneFolder& folder() {
    static const SceneFolder kept;
    static const std::string image = kept.write("one.pfm", pfm_of(2, 2, {1, 1, 1, 1}, 1));
    return kept;
}

Outcome outcome_of(const std::string& text) {
    try {
        return {"", load_scene(folder().write("scene.xml", text))};
    } catch (const InputError& error) {
        return {error.what(), {}};
    }
}

bool mentions(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// Needs files that this test has none of: only what is refused before they are read.
bool is_of_files(std::string_view plugin) {
    return plugin == "obj" || plugin == "ply" || plugin == "serialized" || plugin == "bumpmap";
}

/// What every pixel's mean is, where that is known: the light's own radiance, or the share that the
/// ball sends on of a sky of 1.
std::optional<double> expected_mean(const NumberParameter& p, std::string_view plugin, double v) {
    if (p.name == "radiance") return plugin == "area" ? v : 0.5 * v; // of the sky, a ball of 0.5
    if (plugin == "envmap" && p.name == "scale") return 0.5 * v;
    if (p.name == "reflectance") return v;
    if (plugin == "d65" || plugin == "srgb" || plugin == "uniform") return 0.5 * v;
    // Wider filters than that leave pixels of so small a film without samples.
    if (p.tag == "sampler" || p.tag == "film" || (p.tag == "rfilter" && v <= 1)) return 0.5;
    if (plugin == "conductor" && p.name == "specular_reflectance") return v;
    if (mentions(plugin, "principled")) return std::nullopt; // of lobes that are not white together
    if (plugin == "phong" || plugin == "ward") return std::nullopt; // test_papers_glossy_lobes.cpp
    if (plugin == "roughdiffuse") return 0.4; // half is reflected of what its grooves let out
    bool share_of_white = plugin == "mask" || plugin == "blendbsdf";
    if (p.tag == "bsdf" && (p.form == NumberForm::real || share_of_white)) return 1.0;
    return std::nullopt;
}

struct Range {
    double least = 0, most = 0;
};

/// Noise: of a lobe scaled by up to 70, that of smooth things is rounding.
Range accepted_mean(const NumberParameter& p, std::string_view plugin, double v) {
    std::optional<double> expected = expected_mean(p, plugin, v);
    if (plugin == "depth" || plugin == "aov") return {0.0, 4.0}; // the ball is 3 to 4 away
    if (!expected) return {0.0, p.tag == "emitter" || plugin == "blackbody" ? 3.4e38 : 1.5};
    bool noisy = mentions(plugin, "rough"), light = plugin == "area";
    double error = light ? 1e-5 : noisy ? 0.5 : p.tag == "bsdf" ? 0.1 : 0.2;
    return {*expected * (1 - error), *expected * (1 + error)};
}

void check_image(const Scene& scene, const Range& range) {
    Progress quiet(Progress::Mode::quiet);
    RenderResult result = render_on_host(scene, {}, Precision::single_precision, quiet);
    CHECK(result.report.non_finite_samples == 0);
    const std::vector<float>& values = result.image.channels.front().values;
    double mean = 0.0;
    for (float value : values) {
        REQUIRE(std::isfinite(value));
        CHECK(value >= 0.f);
        mean += double{value} / static_cast<double>(values.size());
    }
    // An image of floats has nothing between 0 and this.
    constexpr double least = std::numeric_limits<float>::denorm_min();
    CHECK(mean >= range.least - least);
    CHECK(mean <= range.most + least);
}

/// Small enough for a test.
bool can_render(const Scene& scene) {
    return scene.film.width * std::int64_t{scene.film.height} <= 64 &&
           scene.sampler.samples_per_pixel <= 64;
}

void resolve_crop(Film& film) {
    if (film.crop_width == 0) film.crop_width = film.width, film.crop_height = film.height;
}

void check_number(const NumberParameter& p, std::string_view plugin, const TriedNumber& number,
                  const std::string& beside) {
    INFO(p.tag << " " << plugin << ", " << p.name << " = " << number.text << " " << beside);
    Outcome outcome = outcome_of(domain_scene(p, plugin, number.text, beside));
    std::optional<double> taken = placed(p.domain, number.value);
    CHECK((!mentions(outcome.refusal, "\n") || is_of_files(plugin)));
    if (!taken) {
        CHECK(mentions(outcome.refusal, "scene.xml:1"));
        if (number.text.size() < 10 && std::isfinite(number.value))
            CHECK(mentions(outcome.refusal, accepted_text(p.domain)));
        return;
    }
    bool noted = std::any_of(outcome.scene.notes.begin(), outcome.scene.notes.end(),
                             [](const std::string& note) { return mentions(note, "taken as"); });
    if (!outcome.refusal.empty()) {
        CHECK((!p.also.empty() || is_of_files(plugin)));
        return;
    }
    CHECK(noted == (*taken != number.value));
    resolve_crop(outcome.scene.film);
    if (!can_render(outcome.scene)) return;
    try {
        check_image(outcome.scene, accepted_mean(p, plugin, *taken));
    } catch (const InputError&) {
        CHECK(!p.also.empty());
    }
}

bool has_microfacets(std::string_view plugin) {
    auto kind = std::find(material_names.begin(), material_names.end(), plugin);
    return kind != material_names.end() && (rough_materials >> (kind - material_names.begin()) & 1);
}

/// What stands beside the number: once nothing, once what else decides what it does.
std::vector<std::string> variants_of(std::string_view plugin) {
    if (!has_microfacets(plugin)) return {""};
    return {"", "<string name='distribution' value='ggx'/>"};
}

/// One ctest entry a kind: they run side by side.
void walk(std::string_view tag) {
    std::size_t walked = 0;
    for (const NumberParameter& p : mitsuba::number_parameters()) {
        if (p.tag != tag) continue;
        for (std::string_view plugin : split(p.plugins, " "))
            for (const TriedNumber& number : tried_numbers(p.domain))
                for (const std::string& beside : variants_of(plugin)) {
                    check_number(p, plugin, number, beside);
                    walked++;
                }
    }
    CHECK(walked >= 14);
}

} // namespace

TEST_CASE("Domains: numbers of emitters", "[domains]") { walk("emitter"); }
TEST_CASE("Domains: numbers of bsdfs", "[domains]") { walk("bsdf"); }
TEST_CASE("Domains: numbers of textures", "[domains]") { walk("texture"); }
TEST_CASE("Domains: numbers of shapes", "[domains]") { walk("shape"); }
TEST_CASE("Domains: numbers of sensors", "[domains]") { walk("sensor"); }
TEST_CASE("Domains: numbers of films", "[domains]") { walk("film"); }
TEST_CASE("Domains: numbers of filters", "[domains]") { walk("rfilter"); }
TEST_CASE("Domains: numbers of samplers", "[domains]") { walk("sampler"); }
TEST_CASE("Domains: numbers of integrators", "[domains]") { walk("integrator"); }
TEST_CASE("Domains: numbers of spectra", "[domains]") { walk("spectrum"); }
TEST_CASE("Domains: numbers of transforms", "[domains]") { walk("transform"); }

TEST_CASE("Domains: indices of a rough interface differ by what the page says", "[domains]") {
    int walked = 0;
    for (const NumberParameter& p : mitsuba::number_parameters()) {
        if (!mentions(p.also, "times ext_ior")) continue;
        CHECK(p.also == "1.003 times ext_ior or more, or less than it by as much");
        for (std::string_view plugin : split(p.plugins, " "))
            for (double outside : {1.0, 1.5, 0.02})
                for (double ratio : {1.003, 1 / 1.003})
                    for (double share : {0.0, 0.99999999, 1.00000001, 2.0}) {
                        double inside = outside * std::pow(ratio, share);
                        CAPTURE(plugin, outside, ratio, share);
                        Outcome outcome =
                            outcome_of(domain_scene(p, plugin, fmt::format("{}", inside),
                                                    fmt::format("<float name='ext_ior' "
                                                                "value='{}'/>",
                                                                outside)));
                        CHECK(outcome.refusal.empty() == (share > 1));
                        if (share < 1)
                            CHECK(mentions(outcome.refusal,
                                           "two indices, one 1.003 times the other or more"));
                        walked++;
                    }
    }
    CHECK(walked == 48); // of two plugins
}
