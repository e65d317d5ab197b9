// Colours and spectra. The expected figures are those of Mitsuba 3.9.1, variant scalar_rgb, for the
// same text.
#include "test_scene_tools.h"

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

Rgb reflectance_of(const std::string& element) {
    const Scene scene =
        load_body("<shape type=\"sphere\"><bsdf type=\"diffuse\">" + element + "</bsdf></shape>");
    return std::get<DiffuseBsdf>(scene.materials.at(0).bsdf).reflectance.constant;
}

Rgb reflectance_of_spectrum(const std::string& value) {
    return reflectance_of("<spectrum name=\"reflectance\" value=\"" + value + "\"/>");
}

Rgb intensity_of(const std::string& element) {
    const Scene scene = load_body("<emitter type=\"point\">" + element + "</emitter>");
    return std::get<PointEmitter>(scene.emitters.at(0)).intensity;
}

Rgb intensity_of_spectrum(const std::string& value) {
    return intensity_of("<spectrum name=\"intensity\" value=\"" + value + "\"/>");
}

void check_color(const Rgb& found, const Rgb& expected, double tolerance) {
    for (int i = 0; i < 3; ++i)
        CHECK(found[i] == Approx(expected[i]).margin(tolerance).epsilon(0));
}

constexpr double float_tolerance = 3e-6; // Mitsuba adds a thousand numbers in single precision

} // namespace

TEST_CASE("scene spectrum: rgb") {
    CHECK(reflectance_of("<rgb name=\"reflectance\" value=\"0.1, 0.2 0.3\"/>") ==
          Rgb(0.1, 0.2, 0.3));
    CHECK(reflectance_of("<rgb name=\"reflectance\" value=\"0.4\"/>") == Rgb(0.4));
    CHECK(reflectance_of("<float name=\"reflectance\" value=\"0.4\"/>") == Rgb(0.4));
    CHECK(reflectance_of("<integer name=\"reflectance\" value=\"1\"/>") == Rgb(1.0));
    // IEC 61966-2-1: code value 188 decodes to 0.50289.
    check_color(reflectance_of("<rgb name=\"reflectance\" value=\"#fFbC00\"/>"),
                Rgb(1.0, 0.502886, 0.0), 1e-6);
}

TEST_CASE("scene spectrum: reflectances under D65") {
    CHECK(reflectance_of_spectrum("0.5") == Rgb(0.5));
    check_color(reflectance_of_spectrum("400:0.5,700:0.5"),
                {0.4976710081100464, 0.4998781979084015, 0.49745455384254456}, float_tolerance);
    check_color(reflectance_of_spectrum("300:0.5,900:0.5"),
                {0.4994926452636719, 0.4994368553161621, 0.499400794506073}, float_tolerance);
    check_color(reflectance_of_spectrum("400:0.1, 500:0.2, 600:0.9, 700:0.4"),
                {0.9564427137374878, 0.4965347945690155, 0.10015614330768585}, float_tolerance);
    check_color(reflectance_of_spectrum("450:0.3,455:0.8,470:0.2,610.5:0.7"),
                {0.326093465089798, 0.48858344554901123, 0.20104026794433594}, float_tolerance);
}

TEST_CASE("scene spectrum: a colour outside sRGB goes to its border and is noted") {
    const Scene scene =
        load_body("<bsdf type=\"diffuse\" id=\"a\">\n<spectrum name=\"reflectance\" "
                  "value=\"400:0.0, 500:0.0, 520:0.9, 700:0.0\"/></bsdf>"
                  "<shape type=\"sphere\"><ref id=\"a\"/></shape>");
    check_color(std::get<DiffuseBsdf>(scene.materials[0].bsdf).reflectance.constant,
                {0.40498095750808716, 0.7055762410163879, 0.0}, float_tolerance);
    REQUIRE(!scene.notes.empty());
    CHECK_THAT(scene.notes[0], Contains("scene.xml:3") && Contains("gamut"));
}

TEST_CASE("scene spectrum: emission is not weighed by D65") {
    CHECK(intensity_of("<float name=\"intensity\" value=\"2\"/>") == Rgb(2.0));
    CHECK(intensity_of("<rgb name=\"intensity\" value=\"20 0 7\"/>") == Rgb(20.0, 0.0, 7.0));
    check_color(intensity_of_spectrum("2.5"),
                {3.0119848251342773, 2.3707275390625, 2.2722902297973633}, float_tolerance);
    check_color(intensity_of_spectrum("400:1,700:1"),
                {1.1996935606002808, 0.9495203495025635, 0.9034433364868164}, float_tolerance);
    check_color(intensity_of_spectrum("400:0, 500:8, 600:15.6, 700:18.4"),
                {20.71083641052246, 10.854634284973145, 2.7711520195007324}, 10 * float_tolerance);
    check_color(intensity_of_spectrum("450:0.3,455:0.8,470:0.2,610.5:0.7"),
                {0.3777860403060913, 0.4753943681716919, 0.16300898790359497}, float_tolerance);
}

TEST_CASE("scene spectrum: indices of refraction have no upper bound") {
    const Scene scene =
        load_body("<shape type=\"sphere\"><bsdf type=\"conductor\">"
                  "<spectrum name=\"eta\" value=\"400:1.5,700:1.5\"/>"
                  "<spectrum name=\"k\" value=\"400:2,500:3,600:4,700:5\"/></bsdf></shape>");
    const auto& bsdf = std::get<ConductorBsdf>(scene.materials.at(0).bsdf);
    check_color(bsdf.index.eta.constant,
                {1.4930130243301392, 1.4996346235275269, 1.492363691329956}, 2 * float_tolerance);
    check_color(bsdf.index.k.constant, {4.403128623962402, 3.428879499435425, 2.397944450378418},
                4 * float_tolerance);
}

TEST_CASE("scene spectrum: from a file") {
    const SceneFolder folder;
    folder.write("a.spd", "# nm value\n400 0.1\n 500\t0.2\r\n\n600 0.9 # peak\n700 0.4");
    const auto file = [&](const std::string& name) {
        return folder.write("scene.xml",
                            scene_text("<bsdf type=\"diffuse\" id=\"a\"><spectrum "
                                       "name=\"reflectance\" filename=\"" +
                                       name +
                                       "\"/></bsdf><shape type=\"sphere\"><ref id=\"a\"/>"
                                       "</shape>"));
    };
    const Scene scene = load_scene(file("a.spd"));
    check_color(std::get<DiffuseBsdf>(scene.materials[0].bsdf).reflectance.constant,
                {0.9564427137374878, 0.4965347945690155, 0.10015614330768585}, float_tolerance);
    folder.write("b.spd", "400 1\n500 1 2\n");
    CHECK_THAT(refusal_of(file("b.spd")), Contains("b.spd:2"));
    folder.write("c.spd", "400 1\n500 x\n");
    CHECK_THAT(refusal_of(file("c.spd")), Contains("c.spd:2") && Contains("\"x\""));
    folder.write("d.spd", "");
    CHECK_THAT(refusal_of(file("d.spd")), Contains("d.spd") && Contains("two"));
    folder.write("e.txt", "400 1\n500 1\n");
    CHECK_THAT(refusal_of(file("e.txt")), Contains("scene.xml:2") && Contains(".spd"));
}

TEST_CASE("scene spectrum: reflectances outside [0, 1] and negative emission are refused") {
    const auto refused = [](const std::string& element, const std::string& part) {
        INFO(element);
        CHECK_THAT(refusal_of_body("<shape type=\"sphere\"><bsdf type=\"diffuse\">\n" + element +
                                   "</bsdf></shape>"),
                   Contains("scene.xml:3") && Contains("\"reflectance\"") && Contains(part));
    };
    refused("<rgb name=\"reflectance\" value=\"0 1.3 0\"/>", "1.3");
    refused("<rgb name=\"reflectance\" value=\"-0.1 0 0\"/>", "-0.1");
    refused("<float name=\"reflectance\" value=\"1.01\"/>", "0 to 1");
    refused("<spectrum name=\"reflectance\" value=\"400:0.5, 500:2\"/>", "0 to 1");
    refused("<vector name=\"reflectance\" value=\"0 0 0\"/>", "<vector>");
    refused("<texture name=\"reflectance\" type=\"rawconstant\"><float name=\"value\" "
            "value=\"1.2\"/></texture>",
            "1.2");
    CHECK_THAT(
        refusal_of_body("<emitter type=\"point\">\n<rgb name=\"intensity\" value=\"-1 0 0\"/>"
                        "</emitter>"),
        Contains("scene.xml:3") && Contains("\"intensity\" is -1"));
}
