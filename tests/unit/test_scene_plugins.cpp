// Every plugin's defaults and parameters. Defaults are those of Mitsuba 3.9.1.
#include "test_scene_tools.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

Scene with_bsdf(const std::string& bsdf) {
    return load_body("<shape type=\"sphere\">" + bsdf + "</shape>");
}

template<typename T>
T bsdf_of(const std::string& plugin, const std::string& parameters = "") {
    const Scene scene = with_bsdf("<bsdf type=\"" + plugin + "\">" + parameters + "</bsdf>");
    REQUIRE(scene.materials.size() == 1);
    return std::get<T>(scene.materials[0].bsdf);
}

template<typename T>
T emitter_of(const std::string& plugin, const std::string& parameters = "") {
    return std::get<T>(
        load_body("<emitter type=\"" + plugin + "\">" + parameters + "</emitter>").emitters.at(0));
}

Scene load_text(const std::string& text) {
    const SceneFolder folder;
    return load_scene(folder.write("scene.xml", "<scene version=\"3.0.0\">" + text + "</scene>"));
}

Scene with_sensor(const std::string& plugin, const std::string& parameters) {
    return load_text("<sensor type=\"" + plugin + "\">" + parameters + "</sensor>");
}

Film film_of(const std::string& parameters) {
    return with_sensor("perspective", "<film type=\"hdrfilm\">" + parameters + "</film>").film;
}

Integrator integrator_of(const std::string& plugin, const std::string& parameters = "") {
    return load_text("<sensor type=\"perspective\"/><integrator type=\"" + plugin + "\">" +
                     parameters + "</integrator>")
        .integrator;
}

} // namespace

TEST_CASE("scene plugins: bsdf defaults") {
    CHECK(bsdf_of<DiffuseBsdf>("diffuse").reflectance == Rgb(0.5));
    const auto conductor = bsdf_of<ConductorBsdf>("conductor");
    CHECK(conductor.index.eta == Rgb(0.0));
    CHECK(conductor.index.k == Rgb(1.0));
    CHECK(conductor.specular_reflectance == Rgb(1.0));
    const auto dielectric = bsdf_of<DielectricBsdf>("dielectric");
    CHECK(dielectric.eta == 1.5046 / 1.000277);
    CHECK(dielectric.specular_transmittance == Rgb(1.0));
    CHECK(bsdf_of<ThinDielectricBsdf>("thindielectric").eta == 1.5046 / 1.000277);
    const auto rough = bsdf_of<RoughConductorBsdf>("roughconductor");
    CHECK(rough.roughness.distribution == MicrofacetDistribution::beckmann);
    CHECK(rough.roughness.alpha_u == 0.1);
    CHECK(rough.roughness.alpha_v == 0.1);
    CHECK(rough.index.k == Rgb(1.0));
    CHECK(rough.energy_compensation);
    CHECK(bsdf_of<RoughDielectricBsdf>("roughdielectric").energy_compensation);
    const std::string plain = "<boolean name=\"energy_compensation\" value=\"false\"/>";
    CHECK(!bsdf_of<RoughConductorBsdf>("roughconductor", plain).energy_compensation);
    CHECK(!bsdf_of<RoughDielectricBsdf>("roughdielectric", plain).energy_compensation);
    const auto frosted = bsdf_of<RoughDielectricBsdf>("roughdielectric");
    CHECK(frosted.roughness.distribution == MicrofacetDistribution::beckmann);
    CHECK(frosted.roughness.alpha_u == 0.1);
    CHECK(frosted.eta == 1.5046 / 1.000277);
    bsdf_of<NullBsdf>("null");
}

TEST_CASE("scene plugins: metals inside what ext_eta names") {
    // Mitsuba 0.6's documentation of `conductor`: both parts over the index outside.
    const std::string gold = "<string name=\"material\" value=\"Au\"/>";
    const auto alone = bsdf_of<ConductorBsdf>("conductor", gold).index;
    for (const auto& [text, outside] :
         {std::pair("<string name=\"ext_eta\" value=\"Water\"/>", 1.333),
          std::pair("<float name=\"ext_eta\" value=\"0.5\"/>", 0.5),
          std::pair("<float name=\"ext_eta\" value=\"1\"/>", 1.0)}) {
        for (const auto& index :
             {bsdf_of<ConductorBsdf>("conductor", gold + text).index,
              bsdf_of<RoughConductorBsdf>("roughconductor", gold + text).index}) {
            CHECK(index.eta.constant == alone.eta.constant / outside);
            CHECK(index.k.constant == alone.k.constant / outside);
        }
    }
    const std::string textured = "<texture name=\"eta\" type=\"checkerboard\"/>";
    CHECK_THROWS_WITH(
        bsdf_of<ConductorBsdf>("conductor", textured + "<float name=\"ext_eta\" value=\"2\"/>"),
        Contains("1 where \"eta\" or \"k\" is a texture"));
    CHECK(bsdf_of<ConductorBsdf>("conductor", textured + "<float name=\"ext_eta\" value=\"1\"/>")
              .index.eta.texture);
}

TEST_CASE("scene plugins: bsdf parameters") {
    const auto glass = bsdf_of<DielectricBsdf>(
        "dielectric", "<string name=\"int_ior\" value=\"Diamond\"/>"
                      "<float name=\"ext_ior\" value=\"1.25\"/>"
                      "<rgb name=\"specular_reflectance\" value=\"0.5\"/>"
                      "<rgb name=\"specular_transmittance\" value=\"0.25 0.5 0.75\"/>");
    CHECK(glass.eta == 2.419 / 1.25);
    CHECK(glass.specular_reflectance == Rgb(0.5));
    CHECK(glass.specular_transmittance == Rgb(0.25, 0.5, 0.75));
    const auto gold =
        bsdf_of<ConductorBsdf>("conductor", "<string name=\"material\" value=\"Au\"/>");
    CHECK(gold.index.eta.constant.x == Approx(0.143035978));
    CHECK(gold.index.k.constant.z == Approx(1.60335922));
    CHECK(
        bsdf_of<ConductorBsdf>("conductor", "<string name=\"material\" value=\"none\"/>").index.k ==
        Rgb(1.0));
    const auto metal = bsdf_of<RoughConductorBsdf>(
        "roughconductor", "<string name=\"distribution\" value=\"ggx\"/>"
                          "<float name=\"alpha_u\" value=\"0.2\"/>"
                          "<float name=\"alpha_v\" value=\"0.3\"/>"
                          "<rgb name=\"eta\" value=\"1.5 2 3\"/><float name=\"k\" value=\"2\"/>"
                          "<boolean name=\"sample_visible\" value=\"false\"/>");
    CHECK(metal.roughness.distribution == MicrofacetDistribution::ggx);
    CHECK(metal.roughness.alpha_u == 0.2);
    CHECK(metal.roughness.alpha_v == 0.3);
    CHECK(metal.index.eta == Rgb(1.5, 2, 3));
    CHECK(metal.index.k == Rgb(2));
}

TEST_CASE("scene plugins: the two sides of a surface") {
    const auto sides = [](const std::string& bsdf) {
        const Scene scene = with_bsdf(bsdf);
        return std::pair(scene.shapes[0].material_front, scene.shapes[0].material_back);
    };
    CHECK(sides("<bsdf type=\"diffuse\"/>") == std::pair(0, no_material));
    CHECK(sides("<bsdf type=\"roughconductor\"/>") == std::pair(0, no_material));
    CHECK(sides("<bsdf type=\"dielectric\"/>") == std::pair(0, 0));
    CHECK(sides("<bsdf type=\"thindielectric\"/>") == std::pair(0, 0));
    CHECK(sides("<bsdf type=\"null\"/>") == std::pair(0, 0));
    const std::string one = "<bsdf type=\"diffuse\"/>", other = "<bsdf type=\"conductor\"/>";
    CHECK(sides("<bsdf type=\"twosided\">" + one + "</bsdf>") == std::pair(0, 0));
    CHECK(sides("<bsdf type=\"twosided\">" + one + other + "</bsdf>") == std::pair(0, 1));
    const Scene named = with_bsdf("<bsdf type=\"twosided\" id=\"wall\">" + one + "</bsdf>");
    CHECK(named.materials[0].id == "wall");
}

TEST_CASE("scene plugins: a shape without bsdf is grey, or black where it emits") {
    const Scene scene = load_body("<shape type=\"sphere\"/><shape type=\"disk\"/>"
                                  "<shape type=\"disk\"><emitter type=\"area\"/></shape>");
    REQUIRE(scene.materials.size() == 2);
    const auto grey = scene.materials[scene.shapes[0].material_front];
    CHECK(std::get<DiffuseBsdf>(grey.bsdf).reflectance == Rgb(0.5));
    CHECK(scene.shapes[1].material_front == scene.shapes[0].material_front);
    CHECK(scene.shapes[1].material_back == no_material);
    const auto black = scene.materials[scene.shapes[2].material_front];
    CHECK(std::get<DiffuseBsdf>(black.bsdf).reflectance == Rgb(0.0));
    CHECK(scene.shapes[2].radiance == Rgb(1.0));
}

TEST_CASE("scene plugins: emitters") {
    CHECK(emitter_of<PointEmitter>("point").position == glm::dvec3(0.0));
    CHECK(emitter_of<PointEmitter>("point").intensity == Rgb(1.0));
    CHECK(
        emitter_of<PointEmitter>("point", "<point name=\"position\" value=\"1 2 3\"/>").position ==
        glm::dvec3(1, 2, 3));
    CHECK(emitter_of<PointEmitter>("point", "<transform name=\"to_world\"><translate x=\"2\"/>"
                                            "<scale value=\"2\"/></transform>")
              .position == glm::dvec3(4, 0, 0));
    const auto spot = emitter_of<SpotEmitter>("spot");
    CHECK(spot.direction == glm::dvec3(0, 0, 1));
    CHECK(spot.cutoff_angle == Approx(glm::radians(20.0)));
    CHECK(spot.beam_width == Approx(glm::radians(15.0)));
    const auto turned = emitter_of<SpotEmitter>(
        "spot",
        "<float name=\"cutoff_angle\" value=\"40\"/><transform name=\"to_world\"><scale "
        "value=\"3\"/><lookat origin=\"0 0 0\" target=\"0 1 1\" up=\"0 1 0\"/></transform>");
    CHECK(glm::length(turned.direction - glm::dvec3(0, std::sqrt(.5), std::sqrt(.5))) < 1e-15);
    CHECK(turned.beam_width == Approx(glm::radians(30.0)));
    CHECK(emitter_of<DirectionalEmitter>("directional").direction == glm::dvec3(0, 0, 1));
    CHECK(emitter_of<DirectionalEmitter>("directional",
                                         "<vector name=\"direction\" value=\"0 0 -2\"/>")
              .direction == glm::dvec3(0, 0, -1));
    CHECK(emitter_of<DirectionalEmitter>("directional",
                                         "<transform name=\"to_world\"><rotate x=\"1\""
                                         " angle=\"90\"/></transform>")
              .direction == glm::dvec3(0, -1, 0));
    CHECK(emitter_of<ConstantEmitter>("constant").radiance == Rgb(1.0));
    CHECK(
        load_body("<emitter type=\"area\" id=\"l\"><float name=\"radiance\" value=\"3\"/></emitter>"
                  "<shape type=\"disk\"><ref id=\"l\"/></shape>")
            .shapes[0]
            .radiance == Rgb(3.0));
    const Scene weighed = load_body("<emitter type=\"point\">\n<float name=\"sampling_weight\" "
                                    "value=\"2\"/></emitter>");
    REQUIRE(weighed.notes.size() == 1);
    CHECK_THAT(weighed.notes[0], Contains("scene.xml:3") && Contains("sampling_weight"));
}

TEST_CASE("scene plugins: sensors") {
    const Scene plain = with_sensor("perspective", "");
    CHECK(plain.camera.focal_length_mm == 50.0);
    CHECK(!plain.camera.fov_degrees);
    CHECK(plain.camera.near_clip == 1e-2);
    CHECK(plain.camera.far_clip == 1e4);
    CHECK(plain.camera.aperture_radius == 0.0);
    CHECK(plain.film.width == 768);
    CHECK(plain.film.height == 576);
    CHECK(plain.film.pixel_format == PixelFormat::rgb);
    CHECK(plain.film.component_format == ComponentFormat::float32);
    CHECK(plain.film.filter.kind == FilterKind::gaussian);
    CHECK(plain.film.filter.stddev == 0.5);
    CHECK(plain.sampler.samples_per_pixel == 4);
    CHECK(plain.integrator.kind == IntegratorKind::path);
    const Camera camera =
        with_sensor("perspective", "<float name=\"fov\" value=\"30\"/>"
                                   "<string name=\"fov_axis\" value=\"diagonal\"/>"
                                   "<float name=\"principal_point_offset_x\" value=\"0.1\"/>"
                                   "<float name=\"principal_point_offset_y\" value=\"-0.2\"/>"
                                   "<float name=\"near_clip\" value=\"1\"/>"
                                   "<float name=\"far_clip\" value=\"9\"/>")
            .camera;
    CHECK(camera.fov_degrees == 30.0);
    CHECK(!camera.focal_length_mm);
    CHECK(camera.fov_axis == FovAxis::diagonal);
    CHECK(camera.principal_point_offset == glm::dvec2(0.1, -0.2));
    CHECK(camera.near_clip == 1.0);
    CHECK(camera.far_clip == 9.0);
    CHECK(with_sensor("perspective", "<string name=\"focal_length\" value=\"35mm\"/>")
              .camera.focal_length_mm == 35.0);
    CHECK(with_sensor("perspective", "<string name=\"focal_length\" value=\"28.5\"/>")
              .camera.focal_length_mm == 28.5);
    const Camera lens = with_sensor("thinlens", "<float name=\"aperture_radius\" value=\"0.2\"/>"
                                                "<float name=\"focus_distance\" value=\"3\"/>")
                            .camera;
    CHECK(lens.aperture_radius == 0.2);
    CHECK(lens.focus_distance == 3.0);
    CHECK(with_sensor("thinlens", "<float name=\"aperture_radius\" value=\"0.2\"/>")
              .camera.focus_distance == 1e4);
}

TEST_CASE("scene plugins: film and filters") {
    const Film film = film_of("<integer name=\"width\" value=\"64\"/>"
                              "<integer name=\"height\" value=\"32\"/>"
                              "<integer name=\"crop_offset_x\" value=\"10\"/>"
                              "<integer name=\"crop_width\" value=\"20\"/>"
                              "<string name=\"pixel_format\" value=\"XYZA\"/>"
                              "<string name=\"component_format\" value=\"float32\"/>"
                              "<string name=\"file_format\" value=\"openexr\"/>"
                              "<boolean name=\"banner\" value=\"false\"/>"
                              "<boolean name=\"high_quality_edges\" value=\"true\"/>"
                              "<boolean name=\"sample_border\" value=\"true\"/>"
                              "<rfilter type=\"box\"/>");
    CHECK(film.crop_x == 10);
    CHECK(film.crop_y == 0);
    CHECK(film.crop_width == 20);
    CHECK(film.crop_height == 32);
    CHECK(film.pixel_format == PixelFormat::xyza);
    CHECK(film.component_format == ComponentFormat::float32);
    CHECK(film.filter.kind == FilterKind::box);
    CHECK(film_of("").crop_width == 0);
    const auto filter = [](const std::string& plugin, const std::string& parameters = "") {
        return film_of("<rfilter type=\"" + plugin + "\">" + parameters + "</rfilter>").filter;
    };
    CHECK(filter("tent").radius == 1.0);
    CHECK(filter("tent", "<float name=\"radius\" value=\"2\"/>").radius == 2.0);
    CHECK(filter("gaussian", "<float name=\"stddev\" value=\"0.7\"/>").stddev == 0.7);
    CHECK(filter("mitchell").mitchell_a == 1.0 / 3.0);
    CHECK(filter("mitchell", "<float name=\"B\" value=\"0.1\"/>").mitchell_a == 0.1);
    CHECK(filter("mitchell", "<float name=\"C\" value=\"0.2\"/>").mitchell_b == 0.2);
    CHECK(filter("catmullrom").kind == FilterKind::catmullrom);
    CHECK(filter("lanczos").lanczos_lobes == 3);
    CHECK(filter("lanczos", "<integer name=\"lobes\" value=\"2\"/>").lanczos_lobes == 2);
}

TEST_CASE("scene plugins: integrators") {
    const Integrator path = integrator_of("path");
    CHECK(path.max_depth == -1);
    CHECK(path.rr_depth == 5);
    CHECK_FALSE(path.hide_emitters);
    const Integrator set =
        integrator_of("path", "<integer name=\"max_depth\" value=\"0\"/>"
                              "<integer name=\"rr_depth\" value=\"9\"/>"
                              "<boolean name=\"hide_emitters\" value=\"true\"/>");
    CHECK(set.max_depth == 0);
    CHECK(set.rr_depth == 9);
    CHECK(set.hide_emitters);
    CHECK(integrator_of("depth").kind == IntegratorKind::depth);
    CHECK(integrator_of("normals").kind == IntegratorKind::normals);
    const Integrator direct =
        integrator_of("direct", "<integer name=\"emitter_samples\" value=\"0\"/>");
    CHECK(direct.kind == IntegratorKind::direct);
    CHECK_FALSE(direct.emitter_samples);
    CHECK(direct.bsdf_samples);
    const Integrator moment = integrator_of("moment", "<integrator type=\"direct\"/>");
    CHECK(moment.kind == IntegratorKind::direct);
    CHECK(moment.second_moment);
    const Integrator aov = integrator_of("aov", "<string name=\"aovs\" value=\"dd.y:depth, "
                                                "nn:sh_normal\"/><integrator type=\"path\"/>");
    CHECK(aov.kind == IntegratorKind::path);
    REQUIRE(aov.aovs.size() == 2);
    CHECK(aov.aovs[0].name == "dd.y");
    CHECK(aov.aovs[1].kind == "sh_normal");
    CHECK(integrator_of("aov", "<string name=\"aovs\" value=\"a:uv\"/>").kind ==
          IntegratorKind::aov);
}

TEST_CASE("scene plugins: samplers are all mapped to ours, and said to be") {
    for (const char* const plugin :
         {"independent", "stratified", "multijitter", "orthogonal", "ldsampler"}) {
        const Scene scene =
            load_text("<integrator type=\"path\"/><sensor type=\"perspective\"><sampler type=\"" +
                      std::string(plugin) +
                      "\"><integer name=\"sample_count\" value=\"17\"/>"
                      "<integer name=\"seed\" value=\"4294967295\"/></sampler></sensor>");
        CHECK(scene.sampler.plugin == plugin);
        CHECK(scene.sampler.samples_per_pixel == 17);
        CHECK(scene.sampler.seed == 4294967295u);
        CHECK(scene.notes.size() == (scene.sampler.plugin == "independent" ? 0 : 1));
    }
}
