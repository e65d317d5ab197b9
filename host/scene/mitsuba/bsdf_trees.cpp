// The bsdf of a surface: a material, or a plugin that holds others.
#include "host/scene/mitsuba/bsdfs.h"
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
    const bool one_sided = (OPAQUE_MATERIALS >> bsdf.index()) & 1;
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
               fmt::format("{} holds {} bsdfs (accepted: {}{})", r.p.title(), children.size(),
                           fewest, most > fewest ? fmt::format(" or {}", most) : ""));
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
    const Rgb share = p.color(name, Rgb(0.5), SpectrumUse::reflectance);
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

#define NESTING_BSDFS(X) X(twosided) X(mask) X(blendbsdf)

SurfaceMaterials read_surface(Reading&& r) {
    using BsdfReader = SurfaceMaterials (*)(Reading&);
#define MATERIAL_PLUGIN(name, ...) PluginEntry<BsdfReader>{#name, read_material<read_##name>},
#define NESTING_PLUGIN(name) PluginEntry<BsdfReader>{#name, read_##name},
    static constexpr std::array plugins{MATERIALS(MATERIAL_PLUGIN) NESTING_BSDFS(NESTING_PLUGIN)};
    return find_plugin(plugins, r.object)(r);
}

} // namespace

SurfaceMaterials read_bsdf(const Document& document, const Object& object, Scene& scene,
                           Notes& notes) {
    return read_surface({document, object, object.id, scene, notes});
}

} // namespace parhelion::mitsuba
