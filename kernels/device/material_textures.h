// What textures tell of materials.
#ifndef PARHELION_MATERIAL_TEXTURES_H
#define PARHELION_MATERIAL_TEXTURES_H

#include "device/texture.h"

/// Less roughness is smooth to single precision, as for constants.
#define LEAST_ROUGHNESS R(1e-9)

FN Real textured_roughness(SceneTables scene, Int row, TexturePlace place, Mask hit,
                           Real otherwise) {
    Mask wanted = hit & (row >= 0);
    Real alpha = maxR(texture_number(scene, row, place, wanted), LEAST_ROUGHNESS);
    return sel(wanted, alpha, otherwise);
}

/// One of the numbers that the table of rows from `first` on tells. Apart: looking up textures is
/// much to compile for each.
FN_APART void tell_number(Real* number, const SceneTables* scene, const Int* first, int k,
                          const TexturePlace* place, const Mask* told) {
    Int row = gather_int(scene->texels, sel(*told, *first + k, (Int)0));
    Mask wanted = *told & (row >= 0);
    if (someLane(wanted))
        *number = sel(wanted, texture_number(*scene, row, *place, wanted), *number);
}

/// Burley's numbers: the words of the record from tr to kb.
FN Material tell_numbers(SceneTables scene, Int code, TexturePlace place, Mask hit, Material m) {
    Mask told = hit & IS_NUMBER_ROWS(code);
    if (!someLane(told)) return m;
    Int first = NUMBER_ROWS_CODE(code);
    Real number[NUMBER_ROWS] = {m.tr, m.tg, m.tb, m.er, m.eg, m.eb, m.kr, m.kg, m.kb};
    for (int k = 0; k < NUMBER_ROWS; k++)
        tell_number(&number[k], &scene, &first, k, &place, &told);
    m.tr = number[0], m.tg = number[1], m.tb = number[2];
    m.er = number[3], m.eg = number[4], m.eb = number[5];
    m.kr = number[6], m.kg = number[7], m.kb = number[8];
    return m;
}

/// The material of row `row` of the materials, its words as textures tell them at the lanes that
/// have hit something.
FN Material resolve_textures(SceneTables scene, Int row, TexturePlace place, Mask hit, Material m) {
    MaterialTextures t = load_MaterialTextures(scene.material_textures, row);
    if (HAS(textured_reflectance)) {
        vec3 c = textured_color(scene, t.reflectance, place, hit, splat3(R(1.)));
        m.r = m.r * c.x, m.g = m.g * c.y, m.b = m.b * c.z;
        // A rough metal's average reflectance stands in place of a transmittance.
        if (HAS(bsdf_roughconductor)) {
            vec3 scale = sel3(m.kind == material_roughconductor, c, splat3(R(1.)));
            m.tr = m.tr * scale.x, m.tg = m.tg * scale.y, m.tb = m.tb * scale.z;
        }
    }
    if (HAS(textured_transmittance)) {
        vec3 c = textured_color(scene, t.transmittance, place, hit, splat3(R(1.)));
        m.tr = m.tr * c.x, m.tg = m.tg * c.y, m.tb = m.tb * c.z;
    }
    if (HAS(textured_index)) {
        vec3 eta = textured_color(scene, t.eta, place, hit, material_eta(m));
        vec3 k = textured_color(scene, t.k, place, hit, material_k(m));
        m.er = eta.x, m.eg = eta.y, m.eb = eta.z;
        m.kr = k.x, m.kg = k.y, m.kb = k.z;
    }
    if (HAS(textured_roughness)) {
        m.alpha_u = textured_roughness(scene, t.alpha_u, place, hit, m.alpha_u);
        m.alpha_v = textured_roughness(scene, t.alpha_v, place, hit, m.alpha_v);
    }
    if (HAS(textured_numbers)) m = tell_numbers(scene, t.transmittance, place, hit, m);
    return m;
}

#endif
