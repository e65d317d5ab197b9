// Which features textures need.
#include "host/flatten/texture_features.h"

#include "host/flatten/feature_counts.h"
#include "host/flatten/texture_records.h"

#include <span>

namespace parhelion {
namespace {

constexpr std::array texture_features{TEXTURES(FEATURE_TEXTURE)};

/// Whether any of these words is a texture's row.
template<class... Words>
auto has_row(Words... words) {
    return [=](const MaterialTexturesRecord& t) { return ((t.*words >= 0) || ...); };
}

} // namespace

void decide_texture_features(const DeviceScene& records, FeatureDecisions& out) {
    using Rows = MaterialTexturesRecord;
    const std::span<const TextureRecord> textures = surface_textures(records);
    decide_kinds(out, texture_features, textures_by_place(records), "textures",
                 [](const TextureRecord& t) { return TEXTURE_KIND(t.form); });
    out.decide(feature_textures, !textures.empty(), counted(textures.size(), "texture"));
    auto decide = [&](Feature f, auto needs) {
        decide_by_count(out, f, records.material_textures, "materials", needs);
    };
    decide(feature_textured_reflectance, has_row(&Rows::reflectance));
    decide(feature_textured_transmittance, has_row(&Rows::transmittance));
    decide(feature_textured_index, has_row(&Rows::eta, &Rows::k));
    decide(feature_textured_roughness, has_row(&Rows::alpha_u, &Rows::alpha_v));
    decide(feature_textured_numbers, [](const Rows& t) { return IS_NUMBER_ROWS(t.transmittance); });
    decide_by_count(out, feature_textured_blends, records.lobes, "lobes",
                    [](const LobeRecord& lobe) { return lobe.factor0 != 0; });
    auto tilted_by = [](bool normals) {
        return
            [=](const Rows& t) { return t.tilt >= 0 && ((t.tilt & TILT_NORMALS) != 0) == normals; };
    };
    decide(feature_normal_maps, tilted_by(true));
    decide(feature_bump_maps, tilted_by(false));
    constexpr std::array components{feature_texels_byte, feature_texels_half,
                                    feature_texels_single};
    decide_kinds(out, components, records.textures, "textures", [](const TextureRecord& t) {
        bool image = TEXTURE_KIND(t.form) == texture_bitmap;
        return image ? TEXTURE_COMPONENT(t.form) : -1;
    });
}

} // namespace parhelion
