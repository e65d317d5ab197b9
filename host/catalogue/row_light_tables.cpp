// Tables that samples are drawn by: lights whose powers span thirty orders of magnitude; filters
// (filter_draws.cpp). Shares against exact sums, draws against shares, densities against those
// stated.
#include "host/catalogue/filter_draws.h"
#include "host/catalogue/rows.h"

#include "host/numerics/every_kind_scene.h"
#include "host/numerics/statistics.h"
#include "host/parallel.h"
#include "host/scene/mitsuba/scene_builder.h"
#include "host/scene/mitsuba/xml_file.h"
#include "host/twin/device_functions.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "host/numerics/light_tables.h"

namespace parhelion::stress {
namespace {

constexpr int light_count = 60;

/// From 1e-15 to 1e15, in no order.
double power_of(int light) { return std::pow(10, 30. * (light * 37 % light_count) / 59 - 15); }

glm::dvec3 place(Random& random) {
    double x = random.between(-9, 9), y = random.between(0.5, 5);
    return {x, y, random.between(-9, 9)};
}

Scene hall() {
    Scene scene;
    scene.materials.push_back({"", {}, DiffuseBsdf{}});
    scene.shapes.push_back(shape_of(quad({-10, 0, -10}, {0, 0, 20}, {20, 0, 0}), 0, no_material));
    return scene;
}

/// Point lights, whose powers are in proportion to what their author wrote; one in seven is black.
Scene points_hall() {
    Scene scene = hall();
    Random random(3);
    for (int k = 0; k < light_count; k++) {
        if (k % 7 == 0) scene.emitters.push_back(PointEmitter{place(random), Rgb(0.0)});
        scene.emitters.push_back(PointEmitter{place(random), Rgb(power_of(k))});
    }
    return scene;
}

/// Every kind of light, one after the other; a sky and a sun among them.
Scene mixed_hall() {
    Scene scene = hall();
    Random random(4);
    for (int k = 0; k < light_count; k++) {
        glm::dvec3 at = place(random);
        f64::vec3 w = random.direction<F64>();
        glm::dvec3 n(w.x, w.y, w.z), u = glm::normalize(glm::cross(n, {0.3, 0.5, 0.8})),
                                     v = glm::cross(n, u);
        Rgb power(power_of(k));
        Shape shape = shape_of(quad(at, u, v), 0, no_material, power);
        switch (k % 6) {
        case 0:
            scene.emitters.push_back(PointEmitter{at, power});
            break;
        case 1:
            scene.emitters.push_back(SpotEmitter{at, n, 0.9, 0.5, power});
            break;
        case 2:
            shape.geometry = Sphere{at, 0.2};
            scene.shapes.push_back(shape);
            break;
        case 3:
            shape.geometry = Disk{at, 0.3 * u, 0.3 * v};
            scene.shapes.push_back(shape);
            break;
        case 4: // a triangle alone
            std::get<Mesh>(shape.geometry).triangles.pop_back();
            scene.shapes.push_back(shape);
            break;
        default:
            scene.shapes.push_back(shape);
        }
    }
    scene.emitters.push_back(ConstantEmitter{Rgb(1.0)});
    scene.emitters.push_back(DirectionalEmitter{{0, -1, 0}, Rgb(1e-3)});
    return scene;
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum;
}

/// Draws against shares; what is left of 1 is drawn as nothing (pmf 0).
struct Draws {
    double p = 1;          ///< chi-square
    Worst pmf, hint, pair; ///< relative: stated shares, hints, and hints found again
};

Draws draw_lights(const DeviceScene& scene, f32::vec3 p, f32::vec3 n,
                  const std::vector<double>& shares, std::uint64_t count, std::uint64_t seed) {
    std::vector<double> hints = light_probabilities(scene, p, n, true);
    std::vector<double> observed(shares.size() + 1), expected(shares);
    expected.push_back(std::max(0., 1 - sum_of(shares)));
    Random random(seed);
    Draws draws;
    const std::array at{p.x, p.y, p.z}, normal{n.x, n.y, n.z};
    for (std::uint64_t i = 0; i < count; i++) {
        std::uint32_t x = random.bits();
        PickedLight pick = pick_light(scene.light_tree, at, normal, x, random.bits());
        // Where the walk ends at a group that is dark, its row is none.
        f32::Light light = lanes_of(scene.lights[pick.row]);
        bool lit = pick.pmf > 0 && shares[pick.row] > 0;
        observed[lit ? pick.row : shares.size()]++;
        if (!lit || light.pmf <= 0) continue;
        draws.pmf.add(std::fabs(pick.pmf / shares[pick.row] - 1));
        draws.hint.add(std::fabs(pick.pmf_hint / hints[pick.row] - 1));
        draws.pair.add(std::fabs(light_pmf(scene.light_tree, at, pick.row) / pick.pmf_hint - 1));
    }
    for (double& e : expected)
        e *= static_cast<double>(count);
    draws.p = chi_square_p(observed, expected);
    return draws;
}

Check share_check(const std::string& name, double value, double target, std::uint64_t samples) {
    return {.name = "lights, " + name,
            .value = value,
            .target = target,
            .unit = "relative",
            .samples = samples};
}

/// By power alone, where the shares are known from what the author wrote.
Checks by_power(StressRun& run) {
    DeviceScene scene = make_device_scene(points_hall(), LightChoice::power);
    std::vector<double> exact(light_count);
    for (int k = 0; k < light_count; k++)
        exact[k] = power_of(k);
    double total = sum_of(exact), table = 0;
    Worst share;
    for (std::size_t k = 0; k < exact.size() && k < scene.lights.size(); k++) {
        exact[k] /= total;
        table += double{scene.lights[k].pmf};
        share.add(std::fabs(scene.lights[k].pmf / exact[k] - 1));
    }
    std::uint64_t count = run.count(100'000, 2'000'000, 100'000'000);
    f32::vec3 p{1, 2, 3}, n{0, 1, 0};
    std::vector<double> walked = light_probabilities(scene, p, n, false);
    Draws draws = draw_lights(scene, p, n, exact, count, run.seed);
    Worst walk;
    for (std::size_t k = 0; k < exact.size(); k++)
        walk.add(std::fabs(walked[k] / exact[k] - 1));
    Check rows = share_check("by power: rows of the table beside those with power", 0, 0, 0);
    rows.value = std::fabs(static_cast<double>(scene.lights.size()) - light_count);
    rows.unit = "rows";
    Check drawn =
        share_check("by power: chi-square of draws against exact shares", draws.p, 0.001, count);
    drawn.at_least = true, drawn.unit = "p";
    return {rows,
            share_check("by power: sum of all shares, off 1", std::fabs(table - 1), 1e-6, 0),
            share_check("by power: shares in the table", share.value(), 1e-6, light_count),
            share_check("by power: shares by the tree", walk.value(), 1e-6, light_count),
            share_check("by power: shares stated with draws", draws.pmf.value(), 2e-6, count),
            drawn};
}

/// By what may arrive: shares are those of the nodes, in double.
Checks by_importance(StressRun& run) {
    DeviceScene scene = make_device_scene(mixed_hall());
    constexpr std::size_t views = 24;
    std::uint64_t count = run.count(20'000, 500'000, 10'000'000);
    std::vector<Draws> found(views);
    Worst over;
    Random random(run.seed);
    struct View {
        f32::vec3 p, n;
        std::vector<double> shares;
    };
    std::vector<View> list;
    for (std::size_t i = 0; i < views; i++) {
        glm::dvec3 at = scene.frame.point(place(random));
        View v{vec<F32>(at.x, at.y, at.z), random.direction<F32>(), {}};
        v.shares = light_probabilities(scene, v.p, v.n, false);
        over.add(std::max(0., sum_of(v.shares) - 1));
        list.push_back(v);
    }
    parallel_for(views, [&](std::size_t i) {
        found[i] =
            draw_lights(scene, list[i].p, list[i].n, list[i].shares, count, 1000 * run.seed + i);
    });
    double p = 1;
    Worst pmf, hint, pair;
    for (const Draws& d : found) {
        p = std::min(p, d.p);
        pmf.add(d.pmf.value()), hint.add(d.hint.value()), pair.add(d.pair.value());
    }
    Check drawn = share_check("by place: chi-square of draws, smallest p", p,
                              sidak_level(0.01, views), count * views);
    drawn.at_least = true, drawn.unit = "p";
    return {share_check("by place: sum of all shares, above 1", over.value(), 1e-6, views),
            share_check("by place: shares stated with draws", pmf.value(), 1e-5, count * views),
            share_check("by place: hints stated with draws", hint.value(), 1e-5, count * views),
            share_check("by place: hints of draws found again", pair.value(), 1e-5, count * views),
            drawn};
}

/// The density of a sample, and the one asked for at the point that it has found.
Checks densities(StressRun& run) {
    DeviceScene scene = make_device_scene(mixed_hall());
    std::uint64_t count = run.count(10'000, 1'000'000, 100'000'000);
    std::vector<Worst> worst(emitter_kind_count);
    std::vector<std::uint64_t> asked(emitter_kind_count);
    Random random(run.seed);
    for (std::uint64_t i = 0; i < count; i++) {
        f32::Light light = lanes_of(scene.lights[random.bits() % scene.lights.size()]);
        glm::dvec3 at = scene.frame.point(place(random));
        f32::vec3 p = vec<F32>(at.x, at.y, at.z);
        f32::EmitterSample s = emitter_sample(light, p, random.square<F32>());
        if (!(s.inverse_pdf > 0)) continue;
        float pdf = emitter_hit(light, p, s.wi, s.q, true).pdf;
        // The cosine at the light has the rounding of its two unit vectors.
        double cosine = s.distant ? 1 : std::fabs(f32::dot3(s.wi, s.q_normal));
        worst[light.kind].add(cosine * std::fabs(double{pdf} * s.inverse_pdf - 1));
        asked[light.kind]++;
    }
    Checks checks;
#define DENSITY_CHECK(name, ...)                                                                   \
    if (asked[emitter_##name])                                                                     \
        checks.push_back(                                                                          \
            share_check("density of a sample and of its direction, times cosine: " #name,          \
                        worst[emitter_##name].value(), 1e-6, asked[emitter_##name]));
    EMITTERS_BY_ROW(DENSITY_CHECK)
#undef DENSITY_CHECK
    return checks;
}

/// What a table could not hold is refused, by its name: no number, an infinite one, and a kind of
/// light that there is none of yet (with it come checks of its own).
Check refusals() {
    const std::pair<const char*, const char*> texts[] = {
        {R"(<emitter type="point"><rgb name="intensity" value="1, nan, 1"/></emitter>)", "nan"},
        {R"(<emitter type="constant"><rgb name="radiance" value="inf"/></emitter>)", "inf"},
        {R"(<emitter type="constant"><spectrum name="radiance" value="nan"/></emitter>)", "nan"},
        {R"(<emitter type="constant"><rgb name="radiance" value="-1"/></emitter>)", "radiance"},
        {R"(<emitter type="timed_sunsky"/>)", "timed_sunsky"}};
    Check check = share_check("tables: refused, with the name of what is wrong", 0,
                              std::size(texts), std::size(texts));
    check.at_least = true, check.unit = "scenes", check.name = check.name.substr(8);
    for (const auto& [text, name] : texts) {
        try {
            mitsuba::XmlFile xml("scene.xml", fmt::format("<scene version=\"3.0.0\">\n{}\n<sensor "
                                                          "type=\"perspective\"/></scene>",
                                                          text));
            mitsuba::parse_xml_scene(xml, {});
        } catch (const InputError& error) {
            std::string message = error.what();
            if (message.starts_with("scene.xml:2:") && message.find(name) != std::string::npos)
                check.value++;
            else
                check.worst_at = message;
        }
    }
    return check;
}

} // namespace

Checks row_light_tables(StressRun& run) {
    Checks checks;
    auto add = [&](const Checks& more, double done) {
        checks.insert(checks.end(), more.begin(), more.end());
        run.done(done);
    };
    add(by_power(run), 0.3);
    add(by_importance(run), 0.6);
    add(densities(run), 0.8);
    add(filter_draws(run), 1);
    checks.push_back(refusals());
    return checks;
}

} // namespace parhelion::stress
