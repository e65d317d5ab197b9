// What plugins refuse: other plugins, parameters they do not have, and values out of range.
#include "test_scene_tools.h"

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

TEST_CASE("scene refusals: an unknown plugin is named with what is accepted") {
    const std::pair<std::string, std::string> cases[] = {
        {"<shape type=\"torus\"/>", "sphere"},
        {"<emitter type=\"timed_sunsky\"/>", "constant"},
        {"<bsdf type=\"measured\"/>", "twosided"},
        {"<sampler type=\"blue\"/>", "stratified"},
        {"<film type=\"specfilm\"/>", "hdrfilm"},
        {"<rfilter type=\"sinc\"/>", "lanczos"},
        {"<medium type=\"homogeneous\"/>", "shape"},
        {"<phase type=\"hg\"/>", "shape"},
        {"<volume type=\"gridvolume\"/>", "shape"},
        {"<spectrum type=\"blackbody\"/>", "shape"},
    };
    for (const auto& [element, accepted] : cases) {
        const std::size_t start = element.find('"');
        const std::string plugin = element.substr(start, element.rfind('"') - start + 1);
        CHECK_THAT(refusal_of_body(element), Contains("scene.xml:2") && Contains(plugin) &&
                                                 Contains("not supported") && Contains(accepted));
    }
    CHECK_THAT(refusal_of_text("<scene version=\"3.0.0\"><sensor type=\"distant\"/></scene>"),
               Contains("distant") && Contains("thinlens"));
    CHECK_THAT(refusal_of_text("<scene version=\"3.0.0\"><integrator type=\"volpath\"/></scene>"),
               Contains("volpath") && Contains("direct"));
}

TEST_CASE("scene refusals: every plugin refuses a parameter it does not have") {
    const std::string extra = "\n<float name=\"nonsense\" value=\"1\"/>\n";
    std::vector<std::string> bodies;
    for (const char* const b : {"diffuse", "conductor", "dielectric", "thindielectric",
                                "roughconductor", "roughdielectric", "null"})
        bodies.push_back("<bsdf type=\"" + std::string(b) + "\">" + extra + "</bsdf>");
    bodies.push_back("<bsdf type=\"twosided\">" + extra + "<bsdf type=\"diffuse\"/></bsdf>");
    for (const char* const s : {"sphere", "disk", "rectangle", "cube"})
        bodies.push_back("<shape type=\"" + std::string(s) + "\">" + extra + "</shape>");
    for (const char* const e : {"point", "spot", "directional", "constant", "projector"})
        bodies.push_back("<emitter type=\"" + std::string(e) + "\">" + extra + "</emitter>");
    bodies.push_back("<emitter type=\"area\" id=\"a\">" + extra + "</emitter>");
    bodies.push_back("<film type=\"hdrfilm\">" + extra + "</film>");
    for (const char* const f : {"box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"})
        bodies.push_back("<rfilter type=\"" + std::string(f) + "\">" + extra + "</rfilter>");
    for (const char* const s :
         {"independent", "stratified", "multijitter", "orthogonal", "ldsampler"})
        bodies.push_back("<sampler type=\"" + std::string(s) + "\">" + extra + "</sampler>");
    for (const std::string& body : bodies) {
        INFO(body);
        CHECK_THAT(refusal_of_body(body),
                   Contains("scene.xml:3") && Contains("has no parameter \"nonsense\""));
    }
    // What the scene could have said is accepted too, not only what it did.
    CHECK_THAT(refusal_of_body("<bsdf type=\"roughconductor\" id=\"b\">" + extra + "</bsdf>"),
               Contains("alpha_u") && Contains("alpha_v") && Contains("material"));
    for (const char* const i : {"path", "direct", "depth", "normals"})
        CHECK_THAT(refusal_of_text("<scene version=\"3.0.0\"><sensor type=\"perspective\"/>\n"
                                   "<integrator type=\"" +
                                   std::string(i) + "\">" + extra + "</integrator></scene>"),
                   Contains("scene.xml:3") && Contains("\"nonsense\""));
    for (const char* const s : {"perspective", "thinlens"})
        CHECK_THAT(refusal_of_text(
                       "<scene version=\"3.0.0\">\n<sensor type=\"" + std::string(s) + "\">" +
                       extra + "<float name=\"aperture_radius\" value=\"1\"/></sensor></scene>"),
                   Contains("scene.xml:3") && Contains("\"nonsense\""));
}

TEST_CASE("scene refusals: values out of range are refused with their line") {
    struct Case {
        std::string body, part;
    };
    const auto bsdf = [](const std::string& plugin, const std::string& parameters) {
        return "<bsdf type=\"" + plugin + "\">\n" + parameters + "</bsdf>";
    };
    const auto emitter = [](const std::string& plugin, const std::string& parameters) {
        return "<emitter type=\"" + plugin + "\">\n" + parameters + "</emitter>";
    };
    const auto film = [](const std::string& parameters) {
        return "<film type=\"hdrfilm\">\n" + parameters + "</film>";
    };
    const auto shape = [](const std::string& plugin, const std::string& parameters) {
        return "<shape type=\"" + plugin + "\">\n" + parameters + "</shape>";
    };
    const auto sampler = [](const std::string& parameters) {
        return "<sampler type=\"independent\">\n" + parameters + "</sampler>";
    };
    const std::string position = "<point name=\"position\" value=\"0 0 0\"/>";
    const std::string moved = "<transform name=\"to_world\"><translate x=\"1\"/></transform>";
    const Case cases[] = {
        {bsdf("dielectric", "<float name=\"int_ior\" value=\"0\"/>"), "0.01 to 100"},
        {bsdf("dielectric", "<string name=\"int_ior\" value=\"jelly\"/>"), "bk7"},
        {bsdf("roughdielectric", "<float name=\"int_ior\" value=\"1.000277\"/>"), "two indices"},
        {bsdf("roughconductor", "<float name=\"alpha\" value=\"-1\"/>"), "\"alpha\" is -1"},
        {bsdf("roughconductor", "<float name=\"alpha\" value=\".1\"/><float name=\"alpha_u\" "
                                "value=\".1\"/><float name=\"alpha_v\" value=\".1\"/>"),
         "together"},
        {bsdf("roughconductor", "<string name=\"distribution\" value=\"phong\"/>"),
         "beckmann, ggx"},
        {bsdf("conductor", "<string name=\"material\" value=\"Unobtainium\"/>"), "Au"},
        {bsdf("conductor", "<string name=\"material\" value=\"Au\"/><float name=\"k\" "
                           "value=\"1\"/>"),
         "together"},
        {bsdf("conductor", "<rgb name=\"eta\" value=\"-1e9 0 0\"/>"), "\"eta\" is -1000000000"},
        {bsdf("twosided", "<bsdf type=\"dielectric\"/>"), "\"dielectric\""},
        {bsdf("twosided", "<bsdf type=\"null\"/>"), "\"null\""},
        {bsdf("twosided", "<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>"), "two sides"},
        {emitter("point", position + moved), "together"},
        {emitter("point", "<float name=\"sampling_weight\" value=\"0\"/>"), "greater than 0"},
        {emitter("spot", "<float name=\"cutoff_angle\" value=\"0\"/>"), "less than 180"},
        {emitter("spot", "<float name=\"beam_width\" value=\"30\"/>"), "cutoff_angle"},
        {emitter("spot", "<texture name=\"texture\" type=\"bitmap\"/>"), "\"bitmap\""},
        {emitter("spot", "<transform name=\"to_world\"><scale x=\"2\"/></transform>"), "uniform"},
        {emitter("directional", "<vector name=\"direction\" value=\"0 0 0\"/>"), "not zero"},
        {film("<integer name=\"width\" value=\"0\"/>"), "1 to 65536"},
        {film("<integer name=\"width\" value=\"-5\"/>"), "1 to 65536"},
        {film("<integer name=\"height\" value=\"100000\"/>"), "1 to 65536"},
        {film("<integer name=\"width\" value=\"65536\"/><integer name=\"height\" "
              "value=\"65536\"/>"),
         "pixels in all"},
        {film("<float name=\"width\" value=\"10\"/>"), "<integer>"},
        {film("<string name=\"pixel_format\" value=\"cmyk\"/>"), "luminance_alpha"},
        {film("<string name=\"component_format\" value=\"float64\"/>"), "float32"},
        {film("<string name=\"file_format\" value=\"tiff\"/>"), "openexr"},
        {film("<rfilter type=\"gaussian\"><float name=\"stddev\" value=\"0\"/></rfilter>"),
         "1e-06 to 4"},
        {film("<rfilter type=\"lanczos\"><integer name=\"lobes\" value=\"0\"/></rfilter>"),
         "1 to 16"},
        {film("<rfilter type=\"mitchell\"><float name=\"A\" value=\"0\"/></rfilter>"), "B, C"},
        {film("<rfilter type=\"box\"/><rfilter type=\"box\"/>"), "more than one"},
        {sampler("<integer name=\"sample_count\" value=\"0\"/>"), "1 to 2147483647"},
        {sampler("<integer name=\"sample_count\" value=\"9999999999\"/>"), "1 to 2147483647"},
        {sampler("<integer name=\"seed\" value=\"-1\"/>"), "0 to 4294967295"},
        {shape("sphere", "<transform name=\"to_world\"><scale x=\"2\"/></transform>"), "ellipsoid"},
        {shape("sphere", "<boolean name=\"face_normals\" value=\"true\"/>"), "face_normals"},
        {shape("sphere", "<bsdf type=\"null\"/><bsdf type=\"null\"/>"), "more than one <bsdf>"},
        {shape("sphere", "<emitter type=\"point\"/>"), "\"point\""},
        {shape("sphere", "<sensor type=\"perspective\"/>"), "sensor"},
        {shape("sphere", "<medium type=\"homogeneous\" name=\"interior\"/>"), "homogeneous"},
        {shape("disk", "<transform name=\"to_world\"><scale z=\"0\"/></transform>"), "inverse"},
        {shape("obj", "<integer name=\"filename\" value=\"1\"/>"), "<string>"},
    };
    for (const Case& c : cases) {
        INFO(c.body);
        CHECK_THAT(refusal_of_body(c.body), Contains("scene.xml:3") && Contains(c.part));
    }
    CHECK_THAT(refusal_of_body("\n<emitter type=\"area\"/>"),
               Contains("scene.xml:3") && Contains("inside a <shape>"));
    CHECK_THAT(refusal_of_body("\n<bsdf type=\"twosided\"/>"),
               Contains("scene.xml:3") && Contains("1 or 2"));
    CHECK_THAT(refusal_of_body("\n<shape type=\"ply\"/>"),
               Contains("scene.xml:3") && Contains("lacks its parameter \"filename\""));
}

TEST_CASE("scene refusals: sensors and integrators out of range") {
    struct Case {
        std::string text, part;
    };
    const auto sensor = [](const std::string& parameters) {
        return "<scene version=\"3.0.0\">\n<sensor type=\"perspective\">\n" + parameters +
               "</sensor></scene>";
    };
    const auto integrator = [](const std::string& plugin, const std::string& parameters) {
        return "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>\n<integrator type=\"" +
               plugin + "\">\n" + parameters + "</integrator></scene>";
    };
    const Case cases[] = {
        {sensor("<float name=\"fov\" value=\"180\"/>"), "less than 180"},
        {sensor("<float name=\"fov\" value=\"0\"/>"), "less than 180"},
        {sensor("<string name=\"fov_axis\" value=\"x\"/>"), "fov_axis"},
        {sensor("<string name=\"fov_axis\" value=\"z\"/><float name=\"fov\" value=\"9\"/>"),
         "smaller"},
        {sensor("<string name=\"focal_length\" value=\"9\"/><float name=\"fov\" value=\"9\"/>"),
         "together"},
        {sensor("<string name=\"focal_length\" value=\"long\"/>"), "50mm"},
        {sensor("<string name=\"focal_length\" value=\"-3mm\"/>"), "1e-06 to"},
        {sensor("<float name=\"near_clip\" value=\"0\"/>"), "1e-100 to"},
        {sensor("<float name=\"near_clip\" value=\"5\"/><float name=\"far_clip\" value=\"5\"/>"),
         "far_clip"},
        {sensor("<float name=\"aperture_radius\" value=\"1\"/>"), "aperture_radius"},
        {sensor("<float name=\"shutter_close\" value=\"-1\"/>"), "shutter_open"},
        {sensor("<transform name=\"to_world\"><scale value=\"2\"/></transform>"), "scale"},
        {sensor("<transform name=\"to_world\"><matrix value=\"1 .1 0 0 1 0 0 0 1\"/></transform>"),
         "shear"},
        {sensor("<sampler type=\"independent\"/><sampler type=\"independent\"/>"), "more than one"},
        {integrator("path", "<integer name=\"max_depth\" value=\"-2\"/>"), "-1 to"},
        {integrator("path", "<integer name=\"rr_depth\" value=\"0\"/>"), "1 to"},
        {integrator("path", "<float name=\"timeout\" value=\"3\"/>"), "timeout"},
        {integrator("direct", "<integer name=\"max_depth\" value=\"2\"/>"), "max_depth"},
        {integrator("direct", "<integer name=\"bsdf_samples\" value=\"0\"/><integer "
                              "name=\"emitter_samples\" value=\"0\"/>"),
         "above 0"},
        {integrator("direct", "<integer name=\"shading_samples\" value=\"2\"/><integer "
                              "name=\"emitter_samples\" value=\"1\"/>"),
         "together"},
        {integrator("aov", "<string name=\"aovs\" value=\"depth\"/>"), "name:kind"},
        {integrator("aov", "<string name=\"aovs\" value=\"a:depth,a:uv\"/>"), "twice"},
        {integrator("aov", "<string name=\"aovs\" value=\"\"/>"), "empty"},
    };
    for (const Case& c : cases) {
        INFO(c.text);
        CHECK_THAT(refusal_of_text(c.text), Contains("scene.xml:3") && Contains(c.part));
    }
    CHECK_THAT(refusal_of_text(integrator("moment", "")),
               Contains("scene.xml:2") && Contains("holds 0"));
    CHECK_THAT(refusal_of_text(integrator("aov", "")),
               Contains("scene.xml:2") && Contains("\"aovs\""));
}

TEST_CASE("scene refusals: one line tells of all values of a spectrum") {
    const std::string refusal =
        refusal_of_body("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"400:2 "
                        "500:.5 600:-1 700:3\"/>"
                        "</bsdf>");
    CHECK_THAT(
        refusal,
        Contains("\"reflectance\" is 2, and 2 more of its values like it (accepted: 0 to 1)"));
    CHECK_THAT(refusal, !Contains("\n"));
}
