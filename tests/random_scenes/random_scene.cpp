// Scenes drawn at random, as a user could have written them: XML and OBJ files.
#include "tests/random_scenes/random_scene.h"

#include "tests/random_scenes/draws.h"

namespace parhelion::test {
namespace {

constexpr int setting_count = 8;

std::string rgb(const char* name, double r, double g, double b) {
    return fmt::format("<rgb name=\"{}\" value=\"{}\"/>", name, triple(r, g, b));
}

std::string tint(const char* name, Draws& draws) {
    double r = draws.share(), g = draws.share();
    return rgb(name, r, g, draws.share());
}

std::string light(const char* name, Draws& draws) {
    double power = draws.power();
    return rgb(name, power * draws.share(), power, power * draws.share());
}

std::string vector(const char* tag, const char* name, Draws& draws) {
    double x = draws.place(), y = draws.place();
    return fmt::format("<{} name=\"{}\" value=\"{}\"/>", tag, name, triple(x, y, draws.place()));
}

/// `even`: the same in every direction.
std::string roughness(Draws& draws, bool even = false) {
    const char* distribution = draws.one_of({"ggx", "beckmann"});
    std::string text = fmt::format("<string name=\"distribution\" value=\"{}\"/>", distribution);
    if (even || draws.chance(0.5)) return text + number("alpha", draws.roughness());
    text += number("alpha_u", draws.roughness());
    return text + number("alpha_v", draws.roughness());
}

std::string ward_roughness(Draws& draws) {
    const char* variant = draws.one_of({"balanced", "ward", "ward-duer"});
    std::string text = fmt::format("<string name=\"variant\" value=\"{}\"/>", variant);
    if (draws.chance(0.5)) return text + number("alpha", draws.roughness());
    text += number("alpha_u", draws.roughness());
    return text + number("alpha_v", draws.roughness());
}

std::string metal(Draws& draws) {
    if (draws.chance(0.3))
        return "<string name=\"material\" value=\"Au\"/>" + tint("specular_reflectance", draws);
    double eta = draws.size(), k = draws.size();
    return rgb("eta", eta, draws.size(), eta) + rgb("k", k, k, draws.size());
}

std::string glass(Draws& draws) {
    return number("int_ior", draws.index()) +
           number("ext_ior", draws.chance(0.7) ? 1 : draws.index());
}

/// Burley's numbers, each of them now and then.
std::string principled(Draws& draws, bool thin) {
    std::string text = tint("base_color", draws);
    for (const char* name :
         {"roughness", "anisotropic", "spec_trans", "spec_tint", "sheen", "sheen_tint", "flatness"})
        if (draws.chance(0.5)) text += number(name, draws.share());
    if (draws.chance(0.5)) text += number("eta", draws.index());
    if (thin) return text + number("diff_trans", 2 * draws.share());
    for (const char* name : {"metallic", "clearcoat", "clearcoat_gloss"})
        if (draws.chance(0.5)) text += number(name, draws.share());
    return text;
}

/// `nesting`: how many bsdfs may hold each other.
std::string bsdf(Draws& draws, int nesting = 3) {
    auto plugin = [](const char* type, const std::string& inside) {
        return fmt::format("<bsdf type=\"{}\">{}</bsdf>", type, inside);
    };
    switch (draws.below(nesting > 0 ? 17 : 15)) {
    case 0:
    case 1:
        return plugin("diffuse", tint("reflectance", draws));
    case 2:
        return plugin("conductor", metal(draws));
    case 3:
        return plugin("dielectric", glass(draws));
    case 4:
        return plugin("thindielectric", glass(draws));
    case 5:
        return plugin("roughconductor", roughness(draws) + metal(draws));
    case 6:
        return plugin("roughdielectric", roughness(draws) + glass(draws));
    case 7:
        return plugin("twosided", plugin("diffuse", tint("reflectance", draws)));
    case 8:
        return plugin("plastic", glass(draws) + tint("diffuse_reflectance", draws) +
                                     tint("specular_reflectance", draws));
    case 9:
        return plugin("roughplastic",
                      roughness(draws, true) + glass(draws) + tint("diffuse_reflectance", draws));
    case 11:
        return plugin("principled", principled(draws, false));
    case 12:
        return plugin("principledthin", principled(draws, true));
    case 13:
        return plugin("phong", number("exponent", 1000 * draws.share()) +
                                   tint("diffuse_reflectance", draws) +
                                   tint("specular_reflectance", draws));
    case 14:
        return plugin("ward", ward_roughness(draws) + tint("diffuse_reflectance", draws) +
                                  tint("specular_reflectance", draws));
    case 15:
        return plugin("mask", number("opacity", draws.share()) + bsdf(draws, nesting - 1));
    case 16: {
        std::string weight = number("weight", draws.share()), first = bsdf(draws, nesting - 1);
        return plugin("blendbsdf", weight + first + bsdf(draws, nesting - 1));
    }
    default:
        return plugin("null", "");
    }
}

std::string placed(Draws& draws) {
    std::string text = "<transform name=\"to_world\">";
    if (draws.chance(0.5)) {
        double x = draws.size(), y = draws.size();
        text += fmt::format("<scale x=\"{}\" y=\"{}\" z=\"{}\"/>", x, y, draws.size());
    } else {
        text += fmt::format("<scale value=\"{}\"/>", draws.size());
    }
    double x = draws.between(-1, 1), y = draws.between(-1, 1);
    text += fmt::format("<rotate x=\"{}\" y=\"{}\" z=\"1\" angle=\"{}\"/>", x, y,
                        draws.between(0, 360));
    x = draws.place(), y = draws.place();
    return text +
           fmt::format("<translate x=\"{}\" y=\"{}\" z=\"{}\"/></transform>", x, y, draws.place());
}

std::string shape(Draws& draws) {
    const std::string_view type =
        draws.one_of({"sphere", "rectangle", "disk", "cylinder", "cube", "obj", "obj"});
    std::string text = fmt::format("<shape type=\"{}\">", type);
    if (type == "obj")
        text += fmt::format("<string name=\"filename\" value=\"{}\"/>", mesh_file_name);
    // Two refuse to be stretched.
    if (type == "sphere")
        text += number("radius", draws.size()) + vector("point", "center", draws);
    else if (type == "cylinder")
        text += number("radius", draws.size()) + vector("point", "p0", draws) +
                vector("point", "p1", draws);
    else
        text += placed(draws);
    if (draws.chance(0.2)) text += "<boolean name=\"flip_normals\" value=\"true\"/>";
    text += bsdf(draws);
    if (draws.chance(0.3))
        text += "<emitter type=\"area\">" + light("radiance", draws) + "</emitter>";
    return text + "</shape>\n";
}

/// Without stretching, which a cone of light does not allow.
std::string aimed(Draws& draws) {
    double x = draws.place(), y = draws.place(), z = draws.place();
    double u = draws.place(), v = draws.place();
    return fmt::format("<transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" "
                       "up=\"0.2, 1, 0.1\"/></transform>",
                       triple(x, y, z), triple(u, v, draws.place()));
}

std::string emitter(Draws& draws) {
    switch (draws.below(3)) {
    case 0:
        return "<emitter type=\"point\">" + vector("point", "position", draws) +
               light("intensity", draws) + "</emitter>\n";
    case 1:
        return "<emitter type=\"spot\">" + aimed(draws) + number("cutoff_angle", draws.angle(90)) +
               light("intensity", draws) + "</emitter>\n";
    default:
        return "<emitter type=\"directional\">" + vector("vector", "direction", draws) +
               light("irradiance", draws) + "</emitter>\n";
    }
}

/// Corners, normals and texture coordinates that triangles share; some triangles have no area.
std::string mesh(Draws& draws) {
    std::string text;
    int corners = 3 + draws.below(12);
    for (int i = 0; i < corners; i++) {
        double x = draws.place(), y = draws.place();
        text += fmt::format("v {} {} {}\n", x, y, draws.place());
        text += fmt::format("vn {} {} 1\n", draws.between(-1, 1), draws.between(-1, 1));
        text += fmt::format("vt {} {}\n", draws.between(0, 1), draws.between(0, 1));
    }
    for (int i = 0; i < 2 * corners; i++) {
        text += "f";
        for (int k = 0; k < 3; k++)
            text += fmt::format(" {0}/{0}/{0}", 1 + draws.below(corners));
        text += "\n";
    }
    return text;
}

/// Few, so that scenes share their programs.
std::string integrator(int setting) {
    static constexpr const char* kinds[setting_count] = {
        "<integrator type=\"path\"/>",
        "<integrator type=\"path\"/>",
        "<integrator type=\"path\"/>",
        "<integrator type=\"path\"><boolean name=\"hide_emitters\" value=\"true\"/></integrator>",
        "<integrator type=\"direct\"/>",
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"3\"/></integrator>",
        "<integrator type=\"moment\"><integrator type=\"path\"/></integrator>",
        "<integrator type=\"aov\"><string name=\"aovs\" value=\"a:albedo, n:sh_normal, "
        "g:geo_normal, p:position, u:uv, d:depth, s:shape_index, i:prim_index\"/><integrator "
        "type=\"path\" name=\"image\"/></integrator>"};
    return kinds[setting];
}

std::string sensor(int setting, Draws& draws) {
    bool lens = setting == 2, wide = setting == 1, parallel = setting == 5;
    std::string stretched = parallel ? fmt::format("<scale value=\"{}\"/>", 3 * draws.size()) : "";
    double x = draws.place(), y = draws.place();
    std::string text = fmt::format(
        "<sensor type=\"{}\"><transform name=\"to_world\">{}<lookat origin=\"{}\" "
        "target=\"{}\" up=\"0.1, 1, 0.2\"/></transform>",
        lens       ? "thinlens"
        : parallel ? "orthographic"
                   : "perspective",
        stretched, triple(x, y, 6 * draws.size()), triple(draws.between(-1, 1), 0.1, 0));
    if (lens)
        text += number("aperture_radius", draws.size()) + number("focus_distance", draws.size());
    if (!parallel) text += number("fov", draws.angle(draws.extreme() ? 180 : 100));
    text += fmt::format("<film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer "
                        "name=\"height\" value=\"{}\"/><string name=\"pixel_format\" "
                        "value=\"rgba\"/><rfilter type=\"{}\"/></film>",
                        1 + draws.below(16), 1 + draws.below(12), wide ? "gaussian" : "box");
    return text + fmt::format("<sampler type=\"independent\"><integer name=\"sample_count\" "
                              "value=\"{}\"/></sampler></sensor>\n",
                              1 + draws.below(8));
}

} // namespace

RandomScene random_scene(SceneKind kind, std::uint64_t seed) {
    Draws draws(kind, seed);
    int setting = static_cast<int>(seed % setting_count);
    RandomScene scene{"<scene version=\"3.0.0\">\n" + integrator(setting) + "\n", mesh(draws)};
    scene.xml += sensor(setting, draws);
    int shapes = draws.below(draws.extreme() ? 5 : 7), emitters = draws.below(3);
    for (int i = 0; i < shapes; i++)
        scene.xml += shape(draws);
    for (int i = 0; i < emitters; i++)
        scene.xml += emitter(draws);
    if (draws.chance(0.5))
        scene.xml += "<emitter type=\"constant\">" + light("radiance", draws) + "</emitter>\n";
    scene.xml += "</scene>\n";
    return scene;
}

} // namespace parhelion::test
