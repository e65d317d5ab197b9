// Scenes of other programs, read leniently: what is left out, what takes its place, and that it is
// said; and what is refused all the same.
#include "test_scene_tools.h"

#include <algorithm>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Contains;

namespace {

/// With its own sensor and integrator, as scene_text has them, or others.
Scene load_leniently(const std::string& text) {
    SceneFolder folder;
    LoadOptions options;
    options.lenient = true;
    return load_scene(folder.write("scene.xml", text), options);
}
Scene lenient_body(const std::string& body) { return load_leniently(scene_text(body)); }

std::string lenient_refusal(const std::string& body) {
    SceneFolder folder;
    LoadOptions options;
    options.lenient = true;
    return refusal_of(folder.write("scene.xml", scene_text(body)), options);
}

int notes_with(const Scene& scene, const std::string& part) {
    return static_cast<int>(
        std::count_if(scene.notes.begin(), scene.notes.end(), [&](const std::string& note) {
            return note.find(part) != std::string::npos;
        }));
}

template<class B>
B bsdf_of(const std::string& bsdf) {
    Scene scene = lenient_body("<shape type='sphere'>" + bsdf + "</shape>");
    return std::get<B>(scene.materials.at(0).bsdf);
}

} // namespace

TEST_CASE("lenient: what is refused otherwise is left out, a note each") {
    const std::string body = "<shape type='sphere'>\n<float name='glinty' value='1'/>\n"
                             "<medium name='interior' type='homogeneous'/>\n</shape>\n"
                             "<shape type='torus'/>\n<emitter type='glow'/>\n<mode value='1'/>\n"
                             "<phase type='hg' id='p'/>";
    SceneFolder folder;
    std::string strict = refusal_of(folder.write("scene.xml", scene_text(body)));
    for (const char* line :
         {"scene.xml:3", "scene.xml:4", "scene.xml:6", "scene.xml:7", "scene.xml:8", "scene.xml:9"})
        CHECK_THAT(strict, Contains(line));
    Scene scene = lenient_body(body);
    CHECK(scene.shapes.size() == 1);
    CHECK(scene.emitters.empty());
    for (const char* note : {"scene.xml:3: shape plugin \"sphere\" has no parameter \"glinty\"",
                             "scene.xml:4: shape plugin \"sphere\" cannot hold the medium",
                             "scene.xml:6: shape plugin \"torus\"", "emitter plugin \"glow\"",
                             "unknown element <mode>", "phase plugin \"hg\""})
        CHECK(notes_with(scene, note) == 1);
    CHECK(notes_with(scene, "left out") == 6);
}

TEST_CASE("lenient: integrators, sensors, films, samplers and filters of other programs") {
    Scene scene = load_leniently(
        "<scene version='3.0.0'><integrator type='guidedpath'><integer name='maxDepth' value='3'/>"
        "<integer name='max_depth' value='7'/><float name='budget' value='9'/></integrator>"
        "<sensor type='perspective_rdist'><float name='fov' value='33'/><float name='kc' "
        "value='1'/><film type='streakhdrfilm'><integer name='width' value='12'/><integer "
        "name='height' value='8'/><integer name='num_bins' value='8'/><rfilter "
        "type='wavelet'/></film><sampler type='blue'><integer name='sample_count' "
        "value='5'/></sampler></sensor></scene>");
    CHECK(scene.integrator.kind == IntegratorKind::path);
    CHECK(scene.integrator.max_depth == 7);
    CHECK(scene.camera.fov_degrees == 33);
    CHECK(scene.film.width == 12);
    CHECK(scene.film.height == 8);
    CHECK(scene.film.filter.kind == FilterKind::gaussian);
    CHECK(scene.sampler.samples_per_pixel == 5);
    CHECK(notes_with(scene, "integrator plugin \"guidedpath\" is not known and read as \"path\"; "
                            "left out: maxDepth, budget") == 1);
    CHECK(notes_with(scene, "left out: num_bins") == 1);
    CHECK(notes_with(scene, "read as \"gaussian\"") == 1);
}

TEST_CASE("lenient: bsdfs become their nearest kin") {
    auto disney = bsdf_of<RoughPlasticBsdf>(
        "<bsdf type='disneybsdf'><texture type='checkerboard' name='base_color'/><float "
        "name='roughness' value='.5'/><float name='flatness' value='1'/></bsdf>");
    CHECK(bool(disney.diffuse_reflectance.texture));
    CHECK(disney.roughness.alpha == Approx(0.25));
    auto any =
        bsdf_of<DiffuseBsdf>("<bsdf type='velvet'><rgb name='albedo' value='.3,.2,.1'/></bsdf>");
    CHECK(any.reflectance.constant == Rgb(0.3, 0.2, 0.1));
    auto held = bsdf_of<ConductorBsdf>("<bsdf type='coating'><bsdf type='conductor'/></bsdf>");
    CHECK(held.index.k.constant == Rgb(1));
    auto dull = bsdf_of<RoughConductorBsdf>(
        "<bsdf type='roughconductor'><string name='distribution' value='phong'/></bsdf>");
    CHECK(dull.roughness.distribution == MicrofacetDistribution::beckmann);
    auto plain = bsdf_of<DiffuseBsdf>("<bsdf type='bumpmap'><texture type='checkerboard'/><bsdf "
                                      "type='diffuse'><float name='reflectance' value='.7'/>"
                                      "</bsdf></bsdf>");
    CHECK(plain.reflectance.constant == Rgb(0.7));
    auto untextured = bsdf_of<DiffuseBsdf>(
        "<bsdf type='diffuse'><texture type='marble' name='reflectance'/></bsdf>");
    CHECK(untextured.reflectance.constant == Rgb(0.5));
    Scene sky = lenient_body("<emitter type='sunsky'><float name='turbidity' value='4'/>"
                             "<vector name='sun_color' x='1' y='1' z='1'/></emitter>"
                             "<emitter type='timed_sunsky'/><shape type='Sphere'/>");
    REQUIRE(sky.emitters.size() == 1);
    CHECK(std::get<SunskyEmitter>(sky.emitters[0]).turbidity == 4);
    CHECK(sky.shapes.size() == 1);
}

TEST_CASE("lenient: what is broken is refused all the same") {
    CHECK_THAT(lenient_refusal("<shape type='obj'><string name='filename' value='none.obj'/>"
                               "</shape>"),
               Contains("none.obj"));
    CHECK_THAT(lenient_refusal("<shape type='sphere'><float name='radius' value='-1'/></shape>"),
               Contains("radius"));
    CHECK_THAT(lenient_refusal("<shape type='sphere'><float name='radius' value='wide'/></shape>"),
               Contains("wide"));
    CHECK_THAT(lenient_refusal("<shape type='sphere'><ref id='nobody'/></shape>"),
               Contains("nobody"));
}

TEST_CASE("lenient: of what is given twice one counts, and it is said which") {
    const std::string body = "<shape type='sphere'>\n<float name='radius' value='1'/>\n"
                             "<float name='radius' value='3'/>\n<bsdf type='diffuse' id='a'/>\n"
                             "<bsdf type='plastic' id='b'/></shape>";
    SceneFolder folder;
    const std::string strict = refusal_of(folder.write("scene.xml", scene_text(body)));
    CHECK_THAT(strict, Contains("scene.xml:4: parameter \"radius\" is given twice"));
    CHECK_THAT(refusal_of(folder.write("scene.xml",
                                       scene_text("<shape type='sphere'>\n<bsdf type='diffuse'/>\n"
                                                  "<bsdf type='diffuse'/></shape>"))),
               Contains("scene.xml:4: ") && Contains("more than one <bsdf>"));
    const Scene scene = lenient_body(body);
    CHECK(std::get<Sphere>(scene.shapes.at(0).geometry).radius == 3);
    const int front = scene.shapes.at(0).material_front;
    CHECK(scene.materials.at(static_cast<std::size_t>(front)).id == "a");
    CHECK(notes_with(scene, "scene.xml:4: parameter \"radius\" is given twice") == 1);
    CHECK(notes_with(scene, "the last counts") == 1);
    CHECK(notes_with(scene, "the first counts") == 1);
}
