// The bsdf of a surface: a material, or a plugin that holds others.
#include "host/scene/mitsuba/bsdfs.h"
#include "host/scene/mitsuba/leniency.h"
#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion::mitsuba {

namespace {

/// One bsdf plugin that is being read, and what it adds to.
struct Reading {
    const Document& document;
    const Object& object;
    const std::string& id; ///< its own, or that of what holds it
    Scene& scene;
    Notes& notes;
    Properties p{document, object, notes};
};

SurfaceMaterials read_surface(Reading&& r);

template<Bsdf (*Read)(Properties&)>
SurfaceMaterials read_material(Reading& r) {
    const Bsdf bsdf = Read(r.p);
    r.p.finish();
    const bool one_sided = is_opaque(bsdf);
    const int number = add_material(r.scene, {r.id, r.object.location, bsdf});
    return {number, one_sided ? no_material : number};
}

struct Nested {
    const Child& child;
    const Object& object;
    SurfaceMaterials sides;
};

/// The bsdfs that it holds: from `fewest` to `most` of them.
std::vector<Nested> read_nested(Reading& r, std::size_t fewest, std::size_t most) {
    const std::vector<const Child*> children = r.p.children("bsdf");
    r.p.finish();
    if (children.size() < fewest || children.size() > most)
        refuse(r.object.location,
               fmt::format("{} holds {} bsdf{} (accepted: {}{})", r.p.title(), children.size(),
                           children.size() == 1 ? "" : "s", fewest,
                           most > fewest ? fmt::format(" or {}", most) : ""));
    std::vector<Nested> nested;
    for (const Child* const child : children) {
        const Object& object = r.p.target(*child);
        const std::string& id = object.id.empty() ? r.id : object.id;
        nested.push_back(
            {*child, object, read_surface({r.document, object, id, r.scene, r.notes})});
    }
    return nested;
}

SurfaceMaterials read_twosided(Reading& r) {
    const std::vector<Nested> nested = read_nested(r, 1, 2);
    for (const Nested& n : nested)
        if (n.sides.back != no_material)
            refuse(n.child.location,
                   fmt::format("{} cannot hold the bsdf plugin {}, which light passes through, or "
                               "which has two sides already",
                               r.p.title(), in_quotes(n.object.plugin)));
    return {nested.front().sides.front, nested.back().sides.front};
}

/// On both sides.
SurfaceMaterials blended(Reading& r, const Textured<double>& weight, const SurfaceMaterials& first,
                         const SurfaceMaterials& second) {
    return {add_blend(r.scene, {weight, first.front, second.front}),
            add_blend(r.scene, {weight, first.back, second.back})};
}

/// A share given as a number, as a texture, or as a colour: the mean of its channels, as in Mitsuba
/// 3.
Textured<double> read_share(Properties& p, std::string_view name) {
    if (p.has_texture(name)) return p.textured_number(name, 0.5);
    const Rgb share = p.color(name, Rgb(0.5), SpectrumUse::reflectance, color_or_texture);
    return (share.r + share.g + share.b) / 3.0;
}

SurfaceMaterials read_blendbsdf(Reading& r) {
    if (!r.p.has("weight"))
        refuse(r.object.location,
               r.p.title() +
                   " lacks its parameter \"weight\" (accepted: <float>, <rgb>, <texture>)");
    const Textured<double> weight = read_share(r.p, "weight");
    const std::vector<Nested> nested = read_nested(r, 2, 2);
    return blended(r, weight, nested[0].sides, nested[1].sides);
}

/// Where a mask lets everything through.
int add_nothing(Scene& scene) {
    const auto known =
        std::find_if(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
            return m.location.file.empty() && std::holds_alternative<NullBsdf>(m.bsdf);
        });
    if (known != scene.materials.end()) return static_cast<int>(known - scene.materials.begin());
    return add_material(scene, {"what masks let through", {}, NullBsdf{}});
}

SurfaceMaterials read_mask(Reading& r) {
    const Textured<double> opacity = read_share(r.p, "opacity");
    const SurfaceMaterials nested = read_nested(r, 1, 1)[0].sides;
    if (!opacity.texture && opacity.constant == 1.0) return nested;
    const int nothing = add_nothing(r.scene);
    return blended(r, opacity, {nothing, nothing}, nested);
}

/// Without polarisation a filter is a grey sheet, whatever its angles: the share `passes` of its
/// transmittance goes straight on, the rest is absorbed.
SurfaceMaterials read_filter(Reading& r, double passes) {
    r.p.color("theta", Rgb(0.0), SpectrumUse::reflectance);
    const Rgb transmittance = r.p.color("transmittance", Rgb(1.0), SpectrumUse::reflectance);
    r.p.finish();
    if (transmittance.r != transmittance.g || transmittance.r != transmittance.b)
        r.p.refuse_value("transmittance", "a colour", "a grey");
    const int sheet =
        add_blend(r.scene, {1.0 - passes * transmittance.r, add_nothing(r.scene), no_material});
    return {sheet, sheet};
}

SurfaceMaterials read_polarizer(Reading& r) {
    r.p.boolean("polarizing", true);
    return read_filter(r, 0.5);
}
SurfaceMaterials read_circular(Reading& r) {
    r.p.boolean("left_handed", false);
    return read_filter(r, 0.5);
}
SurfaceMaterials read_retarder(Reading& r) {
    r.p.number("delta", 90.0);
    return read_filter(r, 1.0);
}

SurfaceMaterials read_pplastic(Reading& r) {
    r.notes.push_back(r.object.location.to_string() + ": " + r.p.title() +
                      " is read as \"roughplastic\": nothing is polarised, and its matte "
                      "base is up to a quarter darker");
    Object same = r.object;
    same.plugin = "roughplastic";
    return read_surface({r.document, same, r.id, r.scene, r.notes});
}

/// What is made of `code`, tilted: the materials themselves, and copies of those that stand on both
/// sides where those differ. What is opaque is turned over to be seen from below, and its tilt too.
int tilted(Scene& scene, int code, const Tilt& tilt, bool below) {
    if (code == no_material) return code;
    if (IS_BLEND(code)) {
        Blend b = scene.blends[static_cast<std::size_t>(BLEND_NUMBER(code))];
        const int first = tilted(scene, b.first, tilt, below),
                  second = tilted(scene, b.second, tilt, below);
        if (first == b.first && second == b.second) return code;
        return add_blend(scene, {b.weight, first, second});
    }
    Material& m = scene.materials[static_cast<std::size_t>(code)];
    if (std::holds_alternative<NullBsdf>(m.bsdf)) return code; // has no normal
    Tilt own = tilt;
    if (below && is_opaque(m.bsdf)) own.scale = -own.scale;
    if (m.tilt && m.tilt.scale == own.scale) return code;
    if (m.tilt) {
        Material other = m;
        other.tilt = own;
        return add_material(scene, other);
    }
    m.tilt = own;
    return code;
}

/// What the plugin holds, tilted.
SurfaceMaterials read_tilted(Reading& r, const Tilt& tilt) {
    const std::size_t before = r.scene.materials.size();
    const Nested nested = read_nested(r, 1, 1)[0];
    for (std::size_t i = before; i < r.scene.materials.size(); i++)
        if (r.scene.materials[i].tilt)
            refuse(nested.child.location,
                   r.p.title() + " cannot hold a bsdf that is tilted by another texture already");
    if (tilt.scale == 0.0) return nested.sides;
    return {tilted(r.scene, nested.sides.front, tilt, false),
            tilted(r.scene, nested.sides.back, tilt, true)};
}

Tilt read_tilt(Reading& r) {
    Tilt tilt;
    tilt.texture = r.p.only_bitmap();
    tilt.flips = r.p.boolean("flip_invalid_normals", true);
    tilt.shadows = r.p.boolean("use_shadowing_function", true);
    return tilt;
}

SurfaceMaterials tilted_by_heights(Reading& r) {
    const double scale = r.p.number("scale", 1.0);
    Tilt tilt = read_tilt(r);
    tilt.scale = scale;
    return read_tilted(r, tilt);
}

SurfaceMaterials tilted_by_normals(Reading& r) {
    Tilt tilt = read_tilt(r);
    tilt.of_normals = true;
    const auto& bitmap = std::get<BitmapTexture>(tilt.texture.texture->kind);
    if (bitmap.source.layout.channels < 3)
        refuse(tilt.texture.location,
               fmt::format("{}: {} has one component a texel (accepted: an image of three)",
                           r.p.title(), bitmap.source.name));
    return read_tilted(r, tilt);
}

/// Leniently, where the tilt cannot be used: what it holds as it is.
SurfaceMaterials tilted_or_held(Reading& r, SurfaceMaterials (*read)(Reading&)) {
    if (!r.document.lenient) return read(r);
    try {
        return read(r);
    } catch (const InputError& why) {
        r.notes.push_back(std::string(why.what()) + ": its bsdf is not tilted");
        Reading again{r.document, r.object, r.id, r.scene, r.notes};
        return read_nested(again, 1, 1)[0].sides;
    }
}

SurfaceMaterials read_bumpmap(Reading& r) { return tilted_or_held(r, tilted_by_heights); }
SurfaceMaterials read_normalmap(Reading& r) { return tilted_or_held(r, tilted_by_normals); }

#define OTHER_BSDFS(X)                                                                             \
    X(twosided)                                                                                    \
    X(mask) X(blendbsdf) X(bumpmap) X(normalmap) X(polarizer) X(circular) X(retarder) X(pplastic)

SurfaceMaterials read_surface(Reading&& r) {
    using BsdfReader = SurfaceMaterials (*)(Reading&);
#define MATERIAL_PLUGIN(name, ...) PluginEntry<BsdfReader>{#name, read_material<read_##name>},
#define OTHER_PLUGIN(name) PluginEntry<BsdfReader>{#name, read_##name},
    static constexpr std::array plugins{MATERIALS(MATERIAL_PLUGIN) OTHER_BSDFS(OTHER_PLUGIN)};
    // What takes the place of an unknown one can be unknown as well: what that one holds.
    if (const auto kin = kin_outside(plugins, r.document, r.object, r.notes))
        return read_surface({r.document, *kin, r.id, r.scene, r.notes});
    return find_plugin(plugins, r.object)(r);
}

} // namespace

SurfaceMaterials read_bsdf(const Document& document, const Object& object, Scene& scene,
                           Notes& notes) {
    return read_surface({document, object, object.id, scene, notes});
}

} // namespace parhelion::mitsuba
