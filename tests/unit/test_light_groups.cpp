// Light groups: layers of what each group of emitters sends, which add up to the image.
#include "host/commands/light_group_options.h"
#include "host/error.h"
#include "host/numerics/every_kind_scene.h"
#include "tests/support/host_render.h"
#include "tests/support/two_of_every.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

/// With an id for every emitter: of surfaces s0, s1, ...; of others e0, e1, ...
Scene named(Scene scene) {
    int lamps = 0;
    for (Shape& shape : scene.shapes)
        if (shape.radiance) shape.emitter_id = "s" + std::to_string(lamps++);
    for (std::size_t i = 0; i < scene.emitters.size(); i++)
        scene.emitter_ids.push_back("e" + std::to_string(i));
    return scene;
}

Scene in_groups(Scene scene) {
    scene.integrator.light_groups = light_groups({}, true, scene);
    return scene;
}

Image image_of(const Scene& scene, Precision precision = Precision::single_precision) {
    return host_render(scene, precision).image;
}

const std::vector<float>& values(const Image& image, const std::string& channel) {
    const Channel* const found = find_channel(image, channel);
    REQUIRE(found);
    return found->values;
}

/// The largest difference between a channel and the sum of that of all groups, in parts of all that
/// is added up.
double sum_error(const Image& image, const Scene& scene, const std::string& channel) {
    double worst = 0;
    for (std::size_t i = 0; i < image.pixel_count(); i++) {
        double sum = 0, size = 0;
        for (const LightGroup& group : scene.integrator.light_groups) {
            const double v = values(image, "light." + group.name + "." + channel)[i];
            sum += v, size += std::fabs(v);
        }
        const double off = std::fabs(sum - static_cast<double>(values(image, channel)[i]));
        if (off > 0) worst = std::max(worst, off / size);
    }
    return worst;
}

/// Of what a few dozen vertices bring to a sample.
constexpr double rounding = 16 * 0x1p-24;

/// Without the light of all emitters but one, the colour of whose rows stays in the order they are.
Scene with_light_of(Scene scene, const std::string& id) {
    for (Shape& shape : scene.shapes)
        if (shape.radiance && shape.emitter_id != id) shape.radiance = Rgb(0);
    for (std::size_t i = 0; i < scene.emitters.size(); i++)
        if (auto* sky = std::get_if<ConstantEmitter>(&scene.emitters[i]))
            if (scene.emitter_ids[i] != id) sky->radiance = Rgb(0);
    scene.integrator.light_groups.clear();
    return scene;
}

std::string refusal(const std::vector<std::string>& asked, const Scene& scene,
                    bool by_light = false) {
    try {
        light_groups(asked, by_light, scene);
        return "";
    } catch (const InputError& e) {
        return e.what();
    }
}

} // namespace

TEST_CASE("Light groups: every emitter by itself, all add up to the image", "[light_groups]") {
    for (Scene scene : {named(every_kind_scene()), named(two_of_every())}) {
        for (FilterKind filter : {FilterKind::box, FilterKind::gaussian})
            for (PixelFormat format : {PixelFormat::rgba, PixelFormat::xyz}) {
                scene.film.filter.kind = filter;
                scene.film.pixel_format = format;
                const Scene grouped = in_groups(scene);
                REQUIRE(grouped.integrator.light_groups.size() > 6);
                const Image image = image_of(grouped);
                const bool rgb = format == PixelFormat::rgba;
                for (const char* channel : {rgb ? "R" : "X", rgb ? "G" : "Y", rgb ? "B" : "Z"})
                    CHECK(sum_error(image, grouped, channel) < rounding);
            }
    }
}

TEST_CASE("Light groups: in double too, and the image is that without", "[light_groups]") {
    const Scene scene = named(every_kind_scene()), grouped = in_groups(scene);
    for (Precision precision : {Precision::single_precision, Precision::double_precision}) {
        const Image plain = image_of(scene, precision), image = image_of(grouped, precision);
        CHECK(sum_error(image, grouped, "G") < rounding);
        for (const Channel& channel : plain.channels)
            CHECK(values(image, channel.name) == channel.values);
        CHECK(image.channels.size() ==
              plain.channels.size() + 3 * grouped.integrator.light_groups.size());
    }
}

TEST_CASE("Light groups: what an emitter sends is the image of it alone, to the bit",
          "[light_groups]") {
    // Where lights are not sampled, paths are the same whatever shines.
    Scene scene = named(every_kind_scene());
    scene.integrator.emitter_samples = false;
    scene.integrator.max_depth = 6;
    const Image image = image_of(in_groups(scene));
    int lit = 0;
    for (const char* id : {"s0", "s1", "s2", "e3"}) {
        CAPTURE(id);
        const Image alone = image_of(with_light_of(scene, id));
        for (const char* channel : {"R", "G", "B"}) {
            CHECK(values(image, std::string("light.") + id + "." + channel) ==
                  values(alone, channel));
            lit += values(alone, channel) != std::vector<float>(image.pixel_count());
        }
    }
    CHECK(lit == 12);
    for (const char* dark : {"light.e0.R", "light.e1.R", "light.e2.R", "light.e4.R"})
        CHECK(values(image, dark) == std::vector<float>(image.pixel_count()));
}

TEST_CASE("Light groups: sampled light goes to the group of the light that was sampled",
          "[light_groups]") {
    // A matte floor under two suns of one colour each: each group has that alone, as much of it as
    // the cosine says.
    Scene scene;
    scene.file = "made by the test";
    scene.materials = {{"matte", {}, DiffuseBsdf{Rgb(0.5)}}};
    scene.shapes = {shape_of(quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), 0, no_material)};
    scene.emitters = {DirectionalEmitter{{0, 0, -1}, Rgb(2, 0, 0)},
                      DirectionalEmitter{glm::normalize(glm::dvec3(1, 0, -1)), Rgb(0, 3, 0)}};
    scene.emitter_ids = {"noon", "evening"};
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 5, 1));
    scene.film.width = scene.film.crop_width = 8;
    scene.film.height = scene.film.crop_height = 8;
    scene.film.filter.kind = FilterKind::box;
    scene.sampler.samples_per_pixel = 256;
    scene.integrator.light_groups = light_groups({"evening"}, false, scene);
    const Image image = image_of(scene);
    const auto mean = [&](const char* channel) {
        double sum = 0;
        for (const float v : values(image, channel))
            sum += v / 64;
        return sum;
    };
    // Of 2^14 samples a half to three quarters go to either: six standard errors of that.
    CHECK(mean("light.rest.R") == Approx(2 * 0.5 / M_PI).epsilon(6.0 / 128));
    CHECK(mean("light.evening.G") == Approx(3 * 0.5 / M_PI * std::sqrt(0.5)).epsilon(6.0 / 128));
    for (const char* none : {"light.rest.G", "light.rest.B", "light.evening.R", "light.evening.B"})
        CHECK(mean(none) == 0);
}

TEST_CASE("Light groups: ids are those of emitters or of their shapes, from the file",
          "[light_groups]") {
    const std::string lamp = "<emitter type='area' id='bulb'/>";
    const Scene scene = load_body("<shape type='sphere' id='ball'>" + lamp +
                                  "</shape><shape type='sphere' id='dark'/>"
                                  "<shape type='disk' id='panel'><emitter type='area'/></shape>"
                                  "<emitter type='point' id='flash'/><emitter type='constant'/>");
    const auto names = [&](const std::vector<std::string>& asked, bool by_light) {
        std::string text;
        for (const LightGroup& group : light_groups(asked, by_light, scene))
            text += group.name + " ";
        return text;
    };
    CHECK(names({"bulb"}, false) == "bulb rest ");
    CHECK(names({"ball"}, false) == "ball rest ");
    CHECK(names({"key=ball,flash", "fill=panel"}, false) == "key fill rest ");
    CHECK(names({}, true) == "bulb panel flash rest ");
    CHECK(names({"key=ball,flash"}, true) == "key panel rest ");
    CHECK(names({"key=ball,bulb"}, false) == "key rest "); // twice the same lamp is no harm

    CHECK_THAT(refusal({"bulbe"}, scene), Contains("'bulbe'") && Contains("is it 'bulb'"));
    CHECK_THAT(refusal({"dark"}, scene), Contains("no emitter"));
    CHECK_THAT(refusal({"rest=bulb"}, scene), Contains("'rest'"));
    CHECK_THAT(refusal({"a=bulb", "a=flash"}, scene), Contains("two groups 'a'"));
    CHECK_THAT(refusal({"a=bulb", "b=ball"}, scene), Contains("more than one group: a, b"));
    for (const char* text : {"", "=", "a=", "=bulb", "a=bulb,", "a=,bulb"})
        CHECK_THAT(refusal({text}, scene), Contains("expected NAME=ID"));
    CHECK_THAT(refusal({std::string(201, 'a') + "=bulb"}, scene), Contains("longer than 200"));
    Scene view = scene;
    view.integrator.kind = IntegratorKind::normals;
    CHECK_THAT(refusal({"bulb"}, view), Contains("normals gathers no light"));
}

TEST_CASE("Light groups: none of nothing, and no more than there may be", "[light_groups]") {
    Scene dark;
    CHECK(light_groups({}, true, dark).size() == 1);
    CHECK_THAT(refusal({"bulb"}, dark), Contains("none has an id"));
    Scene many = dark;
    for (int i = 0; i < 65; i++) {
        many.emitters.emplace_back(PointEmitter{{i, 0, 0}, Rgb(1)});
        many.emitter_ids.push_back("e" + std::to_string(i));
    }
    CHECK_THAT(refusal({}, many, true), Contains("65 groups are too many"));
    many.emitters.pop_back();
    CHECK(light_groups({}, true, many).size() == most_light_groups);
}
