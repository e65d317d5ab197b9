// The list of materials, and of each the parameters that scene files give it.
//
// From here come the kinds and their features, the structs of the host (host/scene/material.h),
// what reads them from files and where their numbers may lie, what packs them for the device, and
// the examples and pages made from all of these. The BSDF itself is in bsdf_<name>.h.
#ifndef PARHELION_MATERIALS_H
#define PARHELION_MATERIALS_H

// clang-format off

// Name in files, the host's struct (<Name>Bsdf), what it does with light from below:
//   opaque       nothing: it answers for its upper side, and is turned over to be seen from below
//   matte        so, and what it spreads fades towards a smooth mesh's true horizon where soft shading normals are asked for
//   transparent  it answers for both sides
//   passing      so, and it can let a ray go straight on, as if there were no surface
// (One that is transparent by the list is opaque where its record says so, see below.)
#define MATERIALS(X)                                                                               \
    X(diffuse, Diffuse, matte)                                                                     \
    X(conductor, Conductor, opaque)                                                                \
    X(dielectric, Dielectric, transparent)                                                         \
    X(thindielectric, ThinDielectric, passing)                                                     \
    X(roughconductor, RoughConductor, opaque)                                                      \
    X(roughdielectric, RoughDielectric, transparent)                                               \
    X(null, Null, passing)                                                                         \
    X(roughdiffuse, RoughDiffuse, matte)                                                           \
    X(plastic, Plastic, opaque)                                                                    \
    X(roughplastic, RoughPlastic, opaque)                                                          \
    X(principled, Principled, transparent)                                                         \
    X(principledthin, PrincipledThin, transparent)                                                 \
    X(phong, Phong, opaque)                                                                        \
    X(ward, Ward, opaque)

// Parameters: what it is (host/scene/parameter.h), name, value of one that is missing, where its numbers may lie
// (a domain of host/scene/mitsuba/number_parameters.cpp, or one in brackets), what it becomes in a MaterialRecord: one of
// its words, or several (set_<x> of host/flatten/material_records.cpp).
#define PARAMETERS_diffuse(X)                                                                      \
    X(Color, reflectance, 0.5, share, reflectance)

#define PARAMETERS_conductor(X)                                                                    \
    X(ComplexIndex, index, , complex_index, conductor)                                             \
    X(Color, specular_reflectance, 1.0, share, reflectance)

#define PARAMETERS_dielectric(X)                                                                   \
    X(Index, eta, glass_in_air, refractive_index, interface)                                       \
    X(Color, specular_reflectance, 1.0, share, reflectance)                                        \
    X(Color, specular_transmittance, 1.0, share, transmittance)

#define PARAMETERS_thindielectric(X) PARAMETERS_dielectric(X)

#define PARAMETERS_roughconductor(X)                                                               \
    X(Roughness, roughness, , metal_roughness, roughness)                                          \
    PARAMETERS_conductor(X)                                                                        \
    X(Flag, energy_compensation, true, , nothing)

#define PARAMETERS_roughdielectric(X)                                                              \
    X(Roughness, roughness, , glass_roughness, roughness)                                          \
    X(SeparateIndex, eta, glass_in_air, refractive_index, interface)                               \
    X(Color, specular_reflectance, 1.0, share, reflectance)                                        \
    X(Color, specular_transmittance, 1.0, share, transmittance)                                    \
    X(Flag, energy_compensation, true, , nothing)

#define PARAMETERS_null(X)

// `alpha`: root mean square slope of the surface.
#define PARAMETERS_roughdiffuse(X)                                                                 \
    X(Color, reflectance, 0.5, share, reflectance)                                                 \
    X(Number, alpha, 0.2, (between(0, 10)), alpha_u)

// `nonlinear`: what the coat sends back to the base is tinted each time that it is reflected.
#define PARAMETERS_plastic(X)                                                                      \
    X(Index, eta, plastic_in_air, refractive_index, interface)                                     \
    X(Color, diffuse_reflectance, 0.5, share, reflectance)                                         \
    X(Color, specular_reflectance, 1.0, share, transmittance)                                      \
    X(Flag, nonlinear, false, , nothing)

#define PARAMETERS_roughplastic(X)                                                                 \
    X(EvenRoughness, roughness, , glass_roughness, roughness)                                      \
    X(SeparateIndex, eta, plastic_in_air, refractive_index, interface)                             \
    X(Color, diffuse_reflectance, 0.5, share, reflectance)                                         \
    X(Color, specular_reflectance, 1.0, share, transmittance)                                      \
    X(Flag, nonlinear, false, , nothing)                                                           \
    X(Flag, energy_compensation, true, , nothing)

// Burley's; what words of a record mean then stands below.
#define PARAMETERS_principled(X)                                                                   \
    X(Color, base_color, 0.5, share, reflectance)                                                  \
    X(TexturedNumber, roughness, 0.5, share, alpha_u)                                              \
    X(TexturedNumber, anisotropic, 0.0, share, alpha_v)                                            \
    X(TexturedNumber, metallic, 0.0, share, tr)                                                    \
    X(TexturedNumber, spec_trans, 0.0, share, tg)                                                  \
    X(TexturedNumber, spec_tint, 0.0, share, tb)                                                   \
    X(SpecularIndex, eta, 1.5, refractive_index, er)                                               \
    X(TexturedNumber, sheen, 0.0, share, eg)                                                       \
    X(TexturedNumber, sheen_tint, 0.0, share, eb)                                                  \
    X(TexturedNumber, flatness, 0.0, share, kr)                                                    \
    X(TexturedNumber, clearcoat, 0.0, share, kg)                                                   \
    X(TexturedNumber, clearcoat_gloss, 0.0, share, kb)

// `diff_trans`: 0 reflects, 2 lets through, all that is spread.
#define PARAMETERS_principledthin(X)                                                               \
    X(Color, base_color, 0.5, share, reflectance)                                                  \
    X(TexturedNumber, roughness, 0.5, share, alpha_u)                                              \
    X(TexturedNumber, anisotropic, 0.0, share, alpha_v)                                            \
    X(TexturedNumber, spec_trans, 0.0, share, tg)                                                  \
    X(TexturedNumber, spec_tint, 0.0, share, tb)                                                   \
    X(TexturedNumber, eta, 1.5, refractive_index, er)                                              \
    X(TexturedNumber, sheen, 0.0, share, eg)                                                       \
    X(TexturedNumber, sheen_tint, 0.0, share, eb)                                                  \
    X(TexturedNumber, flatness, 0.0, share, kr)                                                    \
    X(TexturedNumber, diff_trans, 0.0, (between(0, 2)), kg)

// Of Mitsuba 0.x. `ensure_energy_conservation`: reflectances of more than 1 together are scaled down.
#define PARAMETERS_phong(X)                                                                        \
    X(TexturedNumber, exponent, 30.0, (between(0, 1e18)), alpha_u)                                 \
    X(Color, diffuse_reflectance, 0.5, (between(0, 1e6).zero_below(least_normal)), reflectance)    \
    X(Color, specular_reflectance, 0.2, (between(0, 1e6).zero_below(least_normal)), transmittance) \
    X(Flag, ensure_energy_conservation, true, , nothing)

#define PARAMETERS_ward(X)                                                                         \
    X(WardRoughness, roughness, , metal_roughness, ward)                                           \
    X(Color, diffuse_reflectance, 0.5, (between(0, 1e6).zero_below(least_normal)), reflectance)    \
    X(Color, specular_reflectance, 0.2, (between(0, 1e6).zero_below(least_normal)), transmittance) \
    X(Flag, ensure_energy_conservation, true, , nothing)
// clang-format on

#define KIND_MATERIAL(name, ...) material_##name,
enum MaterialKind { MATERIALS(KIND_MATERIAL) material_kind_count };

// Bit k: material kind k is so.
#define SIDES_transparent 0
#define SIDES_opaque 1
#define SIDES_matte 3
#define SIDES_passing 4
#define OPAQUE_BIT(name, Name, sides) | ((SIDES_##sides & 1) << material_##name)
#define MATTE_BIT(name, Name, sides) | ((SIDES_##sides >> 1 & 1) << material_##name)
#define PASSING_BIT(name, Name, sides) | ((SIDES_##sides >> 2 & 1) << material_##name)
#define OPAQUE_MATERIALS (0 MATERIALS(OPAQUE_BIT))
#define MATTE_MATERIALS (0 MATERIALS(MATTE_BIT))
#define PASSING_MATERIALS (0 MATERIALS(PASSING_BIT))

// Records (types.h) of principled materials keep Burley's numbers as scenes give them, roughness
// and anisotropy in place of the alphas; and in bit 0 of the distribution whether nothing goes
// through anywhere, so that they are opaque.
#define METALLIC(m) ((m).tr)
#define SPEC_TRANS(m) ((m).tg)
#define SPEC_TINT(m) ((m).tb)
#define SHEEN(m) ((m).eg)
#define SHEEN_TINT(m) ((m).eb)
#define FLATNESS(m) ((m).kr)
#define CLEARCOAT(m) ((m).kg)
#define DIFF_TRANS(m) ((m).kg)
#define CLEARCOAT_GLOSS(m) ((m).kb)

// Of Ward's the variant: balanced 0, as published 1, Duer's 2.
#define WARD_VARIANT(m) ((m).kr)

// Textures of the numbers from tr to kb (er: eta) have a table: in place of a transmittance's row
// stands the code of the word of `texels` from which on each of them has a row, or -1.
#define NUMBER_WORDS(X) X(tr) X(tg) X(tb) X(er) X(eg) X(eb) X(kr) X(kg) X(kb)
#define NUMBER_ROWS 9
#define NUMBER_ROWS_CODE(word) (-2 - (word))
#define IS_NUMBER_ROWS(code) ((code) < -1)

// What a side of a surface is made of is a number: of a material; or the code of a blend, on the
// device of its first lobe; or -1, which absorbs.
#define BLEND_CODE(number) (-2 - (number))
#define BLEND_NUMBER(code) (-2 - (code))
#define IS_BLEND(code) ((code) < -1)

#endif
