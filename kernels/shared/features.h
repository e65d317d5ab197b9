// The list of what a scene can need. A kernel asks HAS(x) in an ordinary `if`; what a scene does
// not need is not compiled.
//
// The key holds kinds, never values: moving a vertex or a light gives the same programs.
#ifndef PARHELION_FEATURES_H
#define PARHELION_FEATURES_H

#include "shared/materials.h"

// clang-format off
#define GEOMETRIES(X) X(triangle) X(sphere) X(disk) X(cylinder)

// What a parameter of a material can be in place of a constant: name in files, the host's struct (<Name>Texture).
#define TEXTURES(X) X(bitmap, Bitmap) X(checkerboard, Checkerboard) X(mesh_attribute, MeshAttribute)

// Rows of the light table: name, where a ray meets it (enum EmitterPlace). An area emitter has one row for each of its
// primitives.
#define EMITTERS(X) EMITTERS_BY_ROW(X) X(envmap, all_around) X(sunsky, all_around)
// Those of which their row tells all; an envmap has an image and a table (device/environment.h), a sunsky words and a table
// (device/daylight.h).
#define EMITTERS_BY_ROW(X)                                                                         \
    X(area_triangle, on_shapes) X(area_parallelogram, on_shapes) X(area_sphere, on_shapes)         \
    X(area_disk, on_shapes) X(point, nowhere) X(spot, nowhere) X(directional, nowhere)             \
    X(constant, all_around) X(area_tiny_triangle, on_shapes) X(area_cylinder, on_shapes)           \
    X(projector, nowhere)

// First-hit values beside the radiance: name, number of channels, suffixes of the channel names. A channel without suffix is
// for the host: of a position, 1, to know how much of a pixel has one.
#define AOVS(X)                                                                                    \
    X(albedo, 3, "RGB") X(sh_normal, 3, "XYZ") X(geo_normal, 3, "XYZ") X(position, 4, "XYZ")       \
    X(uv, 2, "UV") X(depth, 1, "T") X(shape_index, 1, "I") X(prim_index, 1, "I")

// What the film itself tells of a pixel's samples: name, number of channels, suffixes.
#define FILM_AOVS(X) X(variance, 3, "RGB") X(samples, 1, "N")

// What a scene can need beside its materials, emitters and shapes.
#define OTHER_FEATURES(X)                                                                          \
    X(ray_streams)        /* so many primitives that rays soon part ways */                        \
    X(vertex_normals)     /* some mesh is smooth */                                                \
    X(consistent_normals) /* and its shading keeps to the geometry */                               \
    X(soft_terminator)    /* with diffuse light fading towards the true horizon */                 \
    X(vertex_uvs)         /* some mesh has texture coordinates, and something reads them */         \
    X(analytic_uvs)       /* something reads texture coordinates of spheres and disks */            \
    X(textures)           /* some parameter of a material is a texture; of these: */                \
    X(textured_reflectance) X(textured_transmittance) X(textured_index) X(textured_roughness)      \
    X(textured_numbers)   /* Burley's */                                                           \
    X(textured_blends)    /* and what several materials at once share */                            \
    X(textured_lights)    /* and some surface shines as one tells */                                \
    X(projected_textures) /* some light without size shines through one */                          \
    X(texels_byte) X(texels_half) X(texels_single) /* components of their texels */                 \
    X(back_materials)     /* some opaque surface has a material on its lower side too */            \
    X(blends)             /* some surface is several materials at once */                            \
    X(ggx) X(beckmann) X(anisotropy)                                                               \
    X(clearcoat) X(spec_trans) X(sheen) /* some principled material has that lobe */               \
    X(normal_maps) X(bump_maps) /* some material's normals are tilted, by colours or by heights */ \
    X(tangents)           /* frames lie along texture coordinates: for one of the last three */    \
    X(energy_compensation) /* some rough lobe makes up for what it scatters more than once */      \
    X(faure)              /* samples of a pixel in a pattern; without: independent */               \
    X(replicates)         /* that is several, each scrambled by itself */                           \
    X(thin_lens)                                                                                   \
    X(orthographic)       /* the camera's rays are parallel */                                     \
    X(far_camera)         /* so far from all shapes that rays begin near them */                   \
    X(filter_splatting)   /* a sample counts for all pixels that the filter reaches */              \
    X(filter_sampling)    /* a sample lies where the filter has put it, and counts for one pixel */ \
    X(several_lights)     /* rows of the light table to look up what a ray has met in */            \
    X(light_tree)         /* more than one light to choose from */                                 \
    X(next_event)         /* direct light is sampled at every vertex */                            \
    X(emission)           /* emitters that a ray can meet */                                       \
    X(daylight_sky) X(daylight_sun) /* of a sunsky, either or both of which shine */                \
    X(scattering)         /* paths go on in directions of the BSDF's choice */                      \
    X(straight_through)   /* some surface lets rays go on as they came, and covers nothing then */  \
    X(clear_shadows)      /* and sampled light goes through some of them, as through masks */        \
    X(hide_emitters)                                                                               \
    X(russian_roulette)                                                                            \
    X(view_normals) X(view_depth)                                                                  \
    X(moments)            /* the second moment of the radiance is asked for */                      \
    X(variance)           /* how the samples of a pixel spread is asked for */                      \
    X(shape_ids)          /* which shape a camera ray meets is asked for, of each sample */        \
    X(light_groups)       /* what each group of emitters sends is asked for by itself */           \
    X(aovs)
// clang-format on

#define FEATURE_MATERIAL(name, ...) feature_bsdf_##name,
#define FEATURE_EMITTER(name, ...) feature_emitter_##name,
#define FEATURE_GEOMETRY(name) feature_shape_##name,
#define FEATURE_TEXTURE(name, Name) feature_texture_##name,
#define FEATURE_OTHER(name) feature_##name,
enum Feature {
    MATERIALS(FEATURE_MATERIAL) EMITTERS(FEATURE_EMITTER) GEOMETRIES(FEATURE_GEOMETRY)
        TEXTURES(FEATURE_TEXTURE) OTHER_FEATURES(FEATURE_OTHER) feature_count
};

#define KIND_EMITTER(name, ...) emitter_##name,
enum EmitterKind { EMITTERS(KIND_EMITTER) emitter_kind_count };
enum EmitterPlace { place_nowhere, place_on_shapes, place_all_around };
#define KIND_GEOMETRY(name) geometry_##name,
enum GeometryKind { GEOMETRIES(KIND_GEOMETRY) geometry_kind_count };
#define KIND_TEXTURE(name, Name) texture_##name,
enum TextureKind { TEXTURES(KIND_TEXTURE) texture_kind_count };
#define KIND_AOV(name, channels, suffixes) aov_##name,
enum AovKind { AOVS(KIND_AOV) aov_kind_count };
#define KIND_FILM_AOV(name, channels, suffixes) film_aov_##name,
enum FilmAovKind { FILM_AOVS(KIND_FILM_AOV) film_aov_kind_count };

// Words of 64 bits that hold them all.
#define FEATURE_WORDS 2
#ifdef __OPENCL_C_VERSION__
#define HAS(x)                                                                                     \
    (((feature_##x < 64 ? FEATURES_0 : FEATURES_1) >> (feature_##x & 63)) & 1u) // compiler options
#else
static_assert(feature_count <= 64 * FEATURE_WORDS);
#define HAS(x) (FEATURES.has(feature_##x)) // a FeatureSet (host/feature_set.h)
#endif

// Some light comes from wherever nothing is.
#define OR_SKY(name, place) || (place_##place == place_all_around && HAS(emitter_##name))
#define HAS_SKY (0 EMITTERS(OR_SKY))

#endif
