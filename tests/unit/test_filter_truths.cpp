// Reconstruction filters as their papers have them, and what they make of an edge in a picture,
// along both axes, up to the edges of the film.
#include "host/flatten/filter_table.h"
#include "tests/support/first_hits.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

using namespace parhelion;
using namespace parhelion::test;

namespace {

using Function = std::function<double(double)>;

double sinc(double x) { return x == 0 ? 1 : std::sin(M_PI * x) / (M_PI * x); }

/// Mitchell and Netravali 1988, equation 8.
double mitchell(double x, double b, double c) {
    x = std::fabs(x);
    double k = 0;
    if (x < 1)
        k = (12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b);
    else if (x < 2)
        k = (-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
            (8 * b + 24 * c);
    return k / 6;
}

double gaussian(double x, double deviation) {
    if (std::fabs(x) > 4 * deviation) return 0;
    return std::exp(-x * x / (2 * deviation * deviation)) - std::exp(-8.0);
}

struct FilterCase {
    std::string text;
    double radius;
    Function value;
};

std::string plugin(const std::string& type, const std::string& parameters = "") {
    return "<rfilter type=\"" + type + "\">" + parameters + "</rfilter>";
}

/// Defaults and parameters as Mitsuba 3 documents them.
std::vector<FilterCase> filter_cases() {
    auto tent = [](double r) {
        return [r](double x) { return std::max(0.0, 1 - std::fabs(x) / r); };
    };
    auto lanczos = [](double n) {
        return [n](double x) { return std::fabs(x) < n ? sinc(x) * sinc(x / n) : 0; };
    };
    return {
        {plugin("box"), 0.5, [](double x) { return std::fabs(x) <= 0.5; }},
        {plugin("tent"), 1, tent(1)},
        {plugin("tent", "<float name=\"radius\" value=\"1.7\"/>"), 1.7, tent(1.7)},
        {plugin("gaussian"), 2, [](double x) { return gaussian(x, 0.5); }},
        {plugin("gaussian", "<float name=\"stddev\" value=\"0.8\"/>"), 3.2,
         [](double x) { return gaussian(x, 0.8); }},
        {plugin("mitchell"), 2, [](double x) { return mitchell(x, 1 / 3., 1 / 3.); }},
        {plugin("mitchell", "<float name=\"B\" value=\"0.1\"/><float name=\"C\" value=\"0.6\"/>"),
         2, [](double x) { return mitchell(x, 0.1, 0.6); }},
        {plugin("catmullrom"), 2, [](double x) { return mitchell(x, 0, 0.5); }},
        {plugin("lanczos"), 3, lanczos(3)},
        {plugin("lanczos", "<integer name=\"lobes\" value=\"2\"/>"), 2, lanczos(2)}};
}

constexpr int width = 12, height = 9;

/// A lamp of radiance 1 left of (or above) an edge at film position `edge`, nothing beyond it. One
/// unit of the world is one pixel.
Scene edge_scene(const FilterCase& filter, bool across, double edge, bool border) {
    double at = across ? edge - width / 2. : height / 2. - edge;
    // 100 wide beyond the edge: to the left, or upwards.
    double x = across ? at - 100 : 0, y = across ? 0 : at + 100;
    std::string lamp = fmt::format(
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"100\"/><translate "
        "x=\"{}\" y=\"{}\"/></transform><emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/>"
        "</emitter></shape>",
        x, y);
    double fov = 2 * std::atan(width / 2. / 30) * 180 / M_PI;
    std::string film = fmt::format("<integer name=\"width\" value=\"{}\"/><integer name=\"height\" "
                                   "value=\"{}\"/><boolean name=\"sample_border\" value=\"{}\"/>{}",
                                   width, height, border, filter.text);
    return scene_of_text(
        "<integrator type=\"path\"/>" + lamp +
        looking_down(30, fmt::format("<float name=\"fov\" value=\"{}\"/>", fov), film));
}

/// Integral of f from a to b, where it is not 0.
double integral(const FilterCase& filter, double a, double b) {
    constexpr int cells = 4000;
    a = std::max(a, -filter.radius), b = std::min(b, filter.radius);
    double sum = 0;
    for (int i = 0; i < cells && a < b; i++)
        sum += filter.value(a + (b - a) * (i + 0.5) / cells);
    return a < b ? sum * (b - a) / cells : 0;
}

void check_profile(const FilterCase& filter, bool across, FilterMethod method, bool border) {
    constexpr double edge = 4.3;
    Scene scene = edge_scene(filter, across, edge, border);
    scene.film.filter_method = method;
    scene.sampler.samples_per_pixel = 256;
    Image image = host_image(scene);
    int length = across ? width : height, others = across ? height : width;
    for (int k = 0; k < length; k++) {
        double sum = 0;
        for (int other = 0; other < others; other++)
            sum += value_at(image, "R", across ? image.index(k, other) : image.index(other, k));
        double far = border ? 100 : 0, centre = k + 0.5;
        double truth = integral(filter, -far - centre, edge - centre) /
                       integral(filter, -far - centre, length + far - centre);
        INFO("pixel " << k);
        CHECK(sum / others == Approx(truth).margin(5e-3));
    }
}

} // namespace

TEST_CASE("Filter truths: values are those of the papers, and radii", "[truths]") {
    for (const FilterCase& filter : filter_cases()) {
        INFO(filter.text);
        ReconstructionFilter read = edge_scene(filter, true, 4, false).film.filter;
        CHECK(filter_radius(read) == Approx(filter.radius).epsilon(1e-12));
        for (double x = -4; x <= 4; x += 0.0137)
            REQUIRE(filter_value(read, x) == Approx(filter.value(x)).margin(1e-12));
    }
}

TEST_CASE("Filter truths: samples are placed by the filter", "[truths]") {
    for (const FilterCase& filter : filter_cases()) {
        INFO(filter.text);
        std::vector<FilterBin> bins =
            make_filter_table(edge_scene(filter, true, 4, false).film.filter);
        // Each bin is as likely as the next: |f| has the same integral over each, f the bin's
        // weight of the mean.
        double all = integral(filter, -9, 9), inside = 0;
        auto count = double(bins.size() - 1);
        for (std::size_t b = 0; b + 1 < bins.size(); b++) {
            inside += bins[b].weight / count;
            if (b % 37 == 0)
                REQUIRE(inside == Approx(integral(filter, -9, bins[b + 1].x) / all).margin(2e-4));
        }
        CHECK(inside == Approx(1).epsilon(1e-5));
        CHECK(bins.front().x == Approx(-filter.radius));
        CHECK(bins.back().x == Approx(filter.radius));
        // As dense as |f|.
        double absolute = 0;
        for (std::size_t b = 0; b + 1 < bins.size(); b++)
            absolute += std::fabs(filter.value((bins[b].x + bins[b + 1].x) / 2)) *
                        (bins[b + 1].x - bins[b].x);
        for (std::size_t b = 100; b + 1 < bins.size(); b += 97) {
            double middle = (double(bins[b].x) + bins[b + 1].x) / 2;
            double size = double(bins[b + 1].x) - bins[b].x;
            REQUIRE(std::fabs(filter.value(middle)) * size * count ==
                    Approx(absolute).epsilon(0.05));
        }
    }
}

TEST_CASE("Filter truths: an edge has the filter's profile along both axes", "[truths]") {
    for (const FilterCase& filter : filter_cases())
        for (bool across : {true, false}) {
            INFO(filter.text << (across ? " across" : " down"));
            check_profile(filter, across, FilterMethod::splatting, false);
        }
}

TEST_CASE("Filter truths: placed samples and borders have it too", "[truths]") {
    for (const FilterCase& filter : filter_cases())
        for (bool across : {true, false}) {
            INFO(filter.text << (across ? " across" : " down"));
            if (filter.radius < 2) check_profile(filter, across, FilterMethod::sampling, false);
            check_profile(filter, across, FilterMethod::splatting, true);
        }
}
