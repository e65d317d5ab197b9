// What the command line says comes before what the scene says, and that before the defaults, for
// every option of `render` that has a say in the picture.
#include "host/commands/render.h"
#include "test_scene_tools.h"

#include <fmt/format.h>

#include <functional>
#include <set>

using namespace parhelion;
using namespace parhelion::test;

namespace {

using Arguments = std::vector<std::string>;

RenderCommand parsed(const Arguments& arguments) {
    auto command = std::make_shared<RenderCommand>();
    CommandLine line;
    line.subcommands.push_back({"render", "", "", render_options(*command), [] { return 0; }});
    Arguments all{"render", "scene.xml"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const int code = run_command_line(line, all); // what it refuses is the caller's to expect
    CHECK(code == 0);
    return *command;
}

std::string scene_with(const std::string& integrator, const std::string& sensor) {
    return "<scene version=\"3.0.0\"><default name=\"grey\" value=\"0.25\"/>" + integrator +
           "<sensor type=\"perspective\">" + sensor +
           "</sensor><sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" "
           "value=\"9\"/></film></sensor><shape type=\"sphere\"><bsdf type=\"diffuse\"><float "
           "name=\"reflectance\" "
           "value=\"$grey\"/></bsdf></shape><shape type=\"sphere\"><bsdf type=\"roughconductor\"/>"
           "</shape><emitter type=\"point\" id=\"lamp\"/><emitter type=\"constant\"/></scene>";
}

const std::string bare = scene_with("<integrator type=\"path\"/>", "");
const std::string full = scene_with(
    "<integrator type=\"path\"><integer name=\"max_depth\" value=\"7\"/><integer name=\"rr_depth\" "
    "value=\"3\"/></integrator>",
    "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"21\"/><integer "
    "name=\"seed\" value=\"4\"/></sampler><film type=\"hdrfilm\"><integer name=\"width\" "
    "value=\"50\"/><integer name=\"height\" value=\"40\"/><integer name=\"crop_offset_x\" "
    "value=\"5\"/><integer name=\"crop_offset_y\" value=\"6\"/><integer name=\"crop_width\" "
    "value=\"20\"/><integer name=\"crop_height\" value=\"10\"/></film>");

Scene scene_after(const std::string& text, const Arguments& arguments) {
    const SceneFolder folder;
    RenderCommand command = parsed(arguments);
    Scene scene = load_scene(folder.write("scene.xml", text), load_options(command));
    apply_overrides(command, scene);
    return scene;
}

std::string crop_of(const Scene& s) {
    return fmt::format("{}x{} at {},{} of {}x{}", s.film.crop_width, s.film.crop_height,
                       s.film.crop_x, s.film.crop_y, s.film.width, s.film.height);
}

/// What an option changes, as text: by default, as the scene has it, and with the option given.
struct Precedence {
    std::string option;
    Arguments given;
    std::function<std::string(const Scene&)> value;
    std::string by_default, of_scene, of_command;
};

template<class T>
std::string text(T value) {
    return fmt::format("{}", value);
}

std::vector<Precedence> table() {
    auto integrator = [](auto member) {
        return [member](const Scene& s) { return text(static_cast<int>(s.integrator.*member)); };
    };
    auto sampler = [](auto member) {
        return [member](const Scene& s) { return text(static_cast<int>(s.sampler.*member)); };
    };
    auto grey = [](const Scene& s) {
        return text(std::get<DiffuseBsdf>(s.materials.at(0).bsdf).reflectance.constant.r);
    };
    auto compensation = [](const Scene& s) {
        return text(std::get<RoughConductorBsdf>(s.materials.at(1).bsdf).energy_compensation);
    };
    auto width = [](const Scene& s) { return text(s.film.width); };
    auto method = [](const Scene& s) { return text(static_cast<int>(s.film.filter_method)); };
    auto aovs = [](const Scene& s) {
        std::string names;
        for (const AovRequest& a : s.integrator.aovs)
            names += a.name + ":" + a.kind + " ";
        return names;
    };
    auto groups = [](const Scene& s) {
        std::string names;
        for (const LightGroup& group : s.integrator.light_groups)
            names += group.name + " ";
        return names;
    };
    auto mattes = [](const Scene& s) {
        const CryptomatteRequest& c = s.integrator.cryptomatte;
        return fmt::format("{} {} {}", c.objects, c.materials, c.depth);
    };
    auto kind = [](IntegratorKind k) { return text(static_cast<int>(k)); };
    const std::string path = kind(IntegratorKind::path);
    return {
        {"--spp", {"--spp", "9"}, sampler(&Sampler::samples_per_pixel), "4", "21", "9"},
        {"--seed", {"--seed", "8"}, sampler(&Sampler::seed), "0", "4", "8"},
        {"--sampler", {"--sampler", "independent"}, sampler(&Sampler::pattern), "0", "0", "1"},
        {"--replicates", {"--replicates", "4"}, sampler(&Sampler::replicates), "1", "1", "4"},
        {"--max-depth", {"--max-depth", "2"}, integrator(&Integrator::max_depth), "-1", "7", "2"},
        {"--rr-depth", {"--rr-depth", "9"}, integrator(&Integrator::rr_depth), "5", "3", "9"},
        {"--integrator",
         {"--integrator", "direct"},
         integrator(&Integrator::kind),
         path,
         path,
         kind(IntegratorKind::direct)},
        {"--integrator",
         {"--integrator", "depth"},
         integrator(&Integrator::kind),
         path,
         path,
         kind(IntegratorKind::depth)},
        {"--integrator",
         {"--integrator", "normals"},
         integrator(&Integrator::kind),
         path,
         path,
         kind(IntegratorKind::normals)},
        {"--integrator",
         {"--integrator", "aov"},
         integrator(&Integrator::kind),
         path,
         path,
         kind(IntegratorKind::aov)},
        {"--no-next-event",
         {"--no-next-event"},
         integrator(&Integrator::emitter_samples),
         "1",
         "1",
         "0"},
        {"--shading-normals",
         {"--shading-normals", "raw"},
         integrator(&Integrator::shading_normals),
         "0",
         "0",
         std::to_string(static_cast<int>(ShadingNormals::raw))},
        {"--no-energy-compensation",
         {"--no-energy-compensation"},
         compensation,
         "true",
         "true",
         "false"},
        {"--filter-by", {"--filter-by", "sampling"}, method, "0", "0", "1"},
        {"--aov", {"--aov", "albedo,normals"}, aovs, "", "", "albedo:albedo normals:sh_normal "},
        {"--light-group", {"--light-group", "key=lamp"}, groups, "", "", "key rest "},
        {"--light-groups", {"--light-groups"}, groups, "", "", "lamp rest "},
        {"--cryptomatte",
         {"--cryptomatte", "object"},
         mattes,
         "false false 6",
         "false false 6",
         "true false 6"},
        {"--cryptomatte-depth",
         {"--cryptomatte", "object,material", "--cryptomatte-depth", "3"},
         mattes,
         "false false 6",
         "false false 6",
         "true true 3"},
        {"--sensor", {"--sensor", "1"}, width, "768", "50", "9"},
        {"--define", {"-D", "grey=0.75"}, grey, "0.25", "0.25", "0.75"},
        {"--crop",
         {"--crop", "1,2,3,4"},
         crop_of,
         "768x576 at 0,0 of 768x576",
         "20x10 at 5,6 of 50x40",
         ""},
    };
}

} // namespace

TEST_CASE("Overrides: the command line, then the scene, then the default", "[overrides]") {
    for (const Precedence& row : table()) {
        INFO(row.option);
        CHECK(row.value(scene_after(bare, {})) == row.by_default);
        CHECK(row.value(scene_after(full, {})) == row.of_scene);
        if (row.of_command.empty()) continue;
        CHECK(row.value(scene_after(bare, row.given)) == row.of_command);
        CHECK(row.value(scene_after(full, row.given)) == row.of_command);
    }
    CHECK(crop_of(scene_after(full, {"--crop", "1,2,3,4"})) == "3x4 at 1,2 of 50x40");
    CHECK(crop_of(scene_after(bare, {"--size", "30x20", "--crop", "1,2,29,18"})) ==
          "29x18 at 1,2 of 30x20");
    CHECK_THROWS(scene_after(bare, {"--size", "30x20", "--crop", "1,2,30,18"}));
    CHECK_THROWS(scene_after(bare, {"--size", "30x20", "--crop", "1,2,29,19"}));
}

TEST_CASE("Overrides: no option that decides what a sample is goes untested", "[overrides]") {
    // Above, and in the tests of files.
    std::set<std::string> tested{"--size", "--allow-outside", "--lenient"};
    for (const Precedence& row : table())
        tested.insert(row.option);
    RenderCommand command;
    for (const Option& option : render_options(command)) {
        if (!option.rules.of_samples) continue;
        std::string name = option.names.substr(option.names.find("--"));
        INFO(name);
        CHECK(tested.count(name) == 1);
    }
}

TEST_CASE("Overrides: values that cannot be are refused", "[overrides]") {
    for (const Arguments& wrong : {Arguments{"--spp", "0"},
                                   {"--max-depth", "-2"},
                                   {"--rr-depth", "0"},
                                   {"--size", "0x4"},
                                   {"--size", "4x0"},
                                   {"--size", "65537x1"},
                                   {"--size", "1x65537"},
                                   {"--size", "4"},
                                   {"--cryptomatte", "asset"},
                                   {"--cryptomatte", "object,object"},
                                   {"--cryptomatte", "object", "--cryptomatte-depth", "0"},
                                   {"--cryptomatte", "object", "--cryptomatte-depth", "65"},
                                   {"--light-group", "nobody"},
                                   {"--size", "4x4x4"},
                                   {"--size", "4,4"},
                                   {"--crop", "0,0,0,1"},
                                   {"--crop", "0,0,1,0"},
                                   {"--crop", "-1,0,1,1"},
                                   {"--crop", "0,-1,1,1"},
                                   {"--integrator", "paths"},
                                   {"--sampler", "halton"},
                                   {"--filter-by", "hand"},
                                   {"--sampler", "independent", "--replicates", "2"},
                                   {"--sampler", "faure", "--spp", "7", "--replicates", "8"},
                                   {"--shading-normals", "smooth"}}) {
        INFO(wrong[0] << " " << wrong[1]);
        CHECK_THROWS_AS(scene_after(full, wrong), InputError);
    }
    for (const Arguments& right : {Arguments{"--spp", "1"},
                                   {"--max-depth", "-1"},
                                   {"--rr-depth", "1"},
                                   {"--sampler", "independent", "--replicates", "1"},
                                   {"--sampler", "faure", "--spp", "8", "--replicates", "8"},
                                   {"--size", "65536x1"},
                                   {"--size", "1x65536"},
                                   {"--crop", "49,39,1,1"}})
        CHECK_NOTHROW(scene_after(full, right));
}

TEST_CASE("Overrides: a pixel to trace lies on the film, or on its border", "[overrides]") {
    Film film;
    film.width = 30, film.height = 20;
    CHECK(parse_pixel("29,19", film) == std::array{29, 19});
    for (const char* outside : {"30,0", "0,20", "-1,0", "0,-1", "1", "1,2,3", "a,b"})
        CHECK_THROWS_AS(parse_pixel(outside, film), InputError);
    film.filter.kind = FilterKind::gaussian, film.sample_border = true;
    CHECK(parse_pixel("-2,21", film) == std::array{-2, 21});
    for (const char* outside : {"-3,0", "0,-3", "32,0", "0,22"})
        CHECK_THROWS_AS(parse_pixel(outside, film), InputError);
}
