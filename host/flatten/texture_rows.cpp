// Who in a scene names which texture, and the row of each on the device.
#include "host/flatten/texture_rows.h"

#include "host/flatten/daylight.h"
#include "host/flatten/material_records.h"

#include <algorithm>

namespace parhelion {
namespace {

std::string name_of(const BitmapTexture& bitmap) { return bitmap.source.name; }
std::string name_of(const CheckerboardTexture&) { return "a checkerboard"; }
std::string name_of(const MeshAttributeTexture& attribute) { return attribute.name; }

/// By reference, lest a std::function copy them.
TextureRow row_of(TextureRows& rows) {
    return [&rows](const TextureUse& use) { return rows(use); };
}

/// After the words of its parameters: the texture that tilts its normals.
void set_tilt(MaterialTexturesRecord& t, const Tilt& tilt, const SceneFrame& frame,
              TextureRows& rows) {
    if (!tilt) return;
    t.tilt = rows(tilt.texture) << TILT_SHIFT | (tilt.of_normals ? TILT_NORMALS : 0) |
             (tilt.flips ? TILT_FLIPS : 0) | (tilt.shadows ? TILT_SHADOWS : 0);
    t.tilt_scale = static_cast<float>(tilt.of_normals ? tilt.scale : tilt.scale * frame.scale);
}

/// Of the image around everything, the last; -1: none.
int sky_row(const Scene& scene, TextureRows& rows) {
    for (const Emitter& emitter : scene.emitters)
        if (const auto* sky = std::get_if<EnvmapEmitter>(&emitter))
            return rows.apart(sky->image);
        else if (const auto* daylight = std::get_if<SunskyEmitter>(&emitter))
            if (const TextureUse guide = guide_of(*daylight)) return rows.apart(guide);
    return -1;
}

} // namespace

std::string name_of(const Texture& texture) {
    return std::visit([](const auto& kind) { return name_of(kind); }, texture.kind);
}

NamedTextures name_textures(const Scene& scene, const SceneFrame& frame, bool lights) {
    NamedTextures named;
    TextureRows& rows = named.rows;
    for (const Material& material : scene.materials) {
        MaterialTexturesRecord t = material_textures(material.bsdf, row_of(rows));
        set_tilt(t, material.tilt, frame, rows);
        named.of_materials.push_back(t);
        named.of_numbers.push_back(number_rows(material.bsdf, row_of(rows)));
    }
    for (const Blend& blend : scene.blends)
        named.of_blends.push_back(rows(blend.weight.texture));
    for (const Shape& shape : scene.shapes)
        named.of_shapes.push_back(rows(shape.radiance_texture));
    for (const Emitter& emitter : scene.emitters) {
        const Slide* slide = lights ? slide_of(emitter) : nullptr;
        named.of_emitters.push_back(slide ? rows.apart(slide->texture) : -1);
    }
    if (lights) named.of_sky = sky_row(scene, rows);
    return named;
}

} // namespace parhelion
