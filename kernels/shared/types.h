// Every struct that crosses the bus between host and device, each written once as a list of fields.
//
// A record is up to 16 words of float or int, which a wide device reads four at a time in each lane
// (device/lanes_memory.h). From the same list come the host's struct (XRecord), and the device's
// struct of lanes (X, in records.h).
#ifndef PARHELION_TYPES_H
#define PARHELION_TYPES_H

#ifdef __OPENCL_C_VERSION__
#define LAYOUT(type, size) typedef char layout_of_##type[(sizeof(type) == (size)) ? 1 : -1]
#else
#define LAYOUT(type, size)                                                                         \
    static_assert(sizeof(type) == (size), #type " must have the same layout everywhere")
#endif

#define FIELD_DECLARE(type, name) type name;

// The lists below are tables.
// clang-format off

// ------------------------------------------------------------------------------------------------ geometry
// A primitive as rays meet it and shading sees it; scenes do not store it, but what it is made of (below).
//
// kind      a            b         c         extra
// triangle  vertex 0     vertex 1  vertex 2  1 / |cross(b - a, c - a)|, 0 where that has no length
// sphere    centre       axis x    axis z    radius
// disk      centre       edge u    edge v    1 / |cross(b, c)|
// cylinder  base         axis      side      radius, below 0 where (side, up, axis) is left-handed: u runs from side to up
#define PRIMITIVE_FIELDS(X)                                                                        \
    X(float, ax) X(float, ay) X(float, az)                                                         \
    X(float, bx) X(float, by) X(float, bz)                                                         \
    X(float, cx) X(float, cy) X(float, cz)                                                         \
    X(float, extra)                                                                                \
    X(int, flags)                                /* its shape's */

#define PRIMITIVE_KIND_MASK 3
#define PRIMITIVE_FLIPPED 4  // the normal is reversed (sphere, disk, cylinder)
#define PRIMITIVE_NORMALS 8  // its points have normals
#define PRIMITIVE_UVS 16     // its points have texture coordinates

// Vertex attributes of a triangle: normals and texture coordinates of its three corners.
#define VERTEX_FIELDS(X)                                                                           \
    X(float, n0x) X(float, n0y) X(float, n0z)                                                      \
    X(float, n1x) X(float, n1y) X(float, n1z)                                                      \
    X(float, n2x) X(float, n2y) X(float, n2z)                                                      \
    X(float, u0) X(float, v0) X(float, u1) X(float, v1) X(float, u2) X(float, v2)

// As scenes store them. A primitive: the first words of its points, `extra` as above, its shape's number and flags, and what nearly
// every hit asks for, so that it need not look at the shape.
#define INDEXED_PRIMITIVE_FIELDS(X)                                                                \
    X(int, a) X(int, b) X(int, c) X(float, extra)                                                  \
    X(int, shape)    /* number << PRIMITIVE_FLAG_BITS | flags */                                   \
    X(int, material) /* the shape's front */                                                       \
    X(int, light)    /* row of the light table, -1: does not emit */

#define PRIMITIVE_FLAG_BITS 5
#define PRIMITIVE_FLAGS(shape) ((shape) & ((1 << PRIMITIVE_FLAG_BITS) - 1))
#define PRIMITIVE_SHAPE(shape) ((shape) >> PRIMITIVE_FLAG_BITS)

// A point is a corner, centre, axis or edge: x, y, z; where some mesh of the scene has normals and kernels read them, those; likewise
// texture coordinates.
#define POINT_NORMAL 3
#define POINT_UV(normals) (POINT_NORMAL + ((normals) ? 3 : 0))
#define POINT_WORDS(normals, uvs) (POINT_UV(normals) + ((uvs) ? 2 : 0))

// What all primitives of a shape have in common. There is room, for a transform's row say.
#define SHAPE_FIELDS(X)                                                                            \
    X(int, flags)                                /* geometry kind | PRIMITIVE_* */                  \
    X(int, material_front) X(int, material_back) /* materials.h */                                \
    X(int, first_primitive)                                                                        \
    X(int, unused0) X(int, unused1) X(int, unused2) X(int, unused3)

// -------------------------------------------------------------------------------------- materials and lights
// Dielectrics keep their index in (er, eg, eb, kr, kg, kb): eta, 1/eta, and the high and low parts of eta^2 - 1 seen
// from the outside and from the inside (the low parts decide on which side of the critical angle a direction lies).
// Plastics keep just the outside and, in kg, the average reflectance of their coat from inside, less than 0 if it is nonlinear; and the
// tint of what their coat mirrors in place of a transmittance. Coats of rough ones let kb through to the viewer, eg from the light.
// Rough conductors keep their reflectance, averaged over the cosine, in place of a transmittance. Of principled ones: materials.h.
#define MATERIAL_FIELDS(X)                                                                         \
    X(int, kind)                                                                                   \
    X(float, r) X(float, g) X(float, b)       /* (specular) reflectance */                         \
    X(float, tr) X(float, tg) X(float, tb)    /* specular transmittance */                         \
    X(float, er) X(float, eg) X(float, eb)    /* conductor eta */                                  \
    X(float, kr) X(float, kg) X(float, kb)    /* conductor k */                                    \
    X(float, alpha_u) X(float, alpha_v)                                                            \
    X(int, distribution)                      /* bit 0: 0 GGX, 1 Beckmann; above: 1 + its energy table, 0: none */

// A surface that is several materials at once has a list of lobes, one behind the other: the share of each, of all before it, and how
// many are behind it. Shares add up to 1. Each texture that tells of a share is a factor of it (0: none); `below` means nothing then.
#define LOBE_FIELDS(X)                                                                             \
    X(int, material) X(float, weight) X(float, below) X(int, behind) X(int, factor0) X(int, factor1) X(int, factor2) X(int, factor3)
#define LOBE_FACTORS 4
// What texture `row` tells, or what that leaves of 1.
#define LOBE_FACTOR(row, rest) ((rest) ? -1 - (row) : 1 + (row))

// Of each material the rows of the textures that tell words of its record, where 1 stands; -1: none; less: materials.h.
#define MATERIAL_TEXTURES_FIELDS(X)                                                                \
    X(int, reflectance) X(int, transmittance)                                                      \
    X(int, eta) X(int, k) X(int, alpha_u) X(int, alpha_v) /* eta, k: of a conductor */           \
    X(int, tilt) X(float, tilt_scale)         /* what tilts its normals: row << TILT_SHIFT | TILT_*; times this (normals: -1 below) */
#define TILT_NORMALS 1 // its colours are normals, not heights
#define TILT_FLIPS 2   // normals that would face away from the viewer are turned
#define TILT_SHADOWS 4 // tilted facets shadow each other
#define TILT_SHIFT 3

// Coordinates are taken to (ux u + uy v + ut, vx u + vy v + vt). An image: its size in texels, the word of `texels` that the first
// begins with, their decoding. A checkerboard: its colours. An attribute of meshes: the word of `texels` where a word for each shape
// begins. From that one, counted in primitives from the scene's first, stand three floats of each face, or of each corner of it.
#define TEXTURE_FIELDS(X)                                                                          \
    X(int, form)                              /* TEXTURE_* below */                                \
    X(float, ux) X(float, uy) X(float, ut) X(float, vx) X(float, vy) X(float, vt)                  \
    X(int, width) X(int, height) X(int, first) X(float, r0) X(float, g0) X(float, b0) X(float, r1) X(float, g1) X(float, b1)

#define TEXTURE_KIND(form) ((form) & 15)
#define TEXTURE_NEAREST 16             // not interpolated
#define TEXTURE_WRAP(form) ((form) >> 5 & 3) // 0: repeated, 1: mirrored, 2: its border goes on
#define TEXTURE_WRAP_SHIFT 5
#define TEXTURE_GREY 128               // one component a texel
#define TEXTURE_COMPONENT(form) ((form) >> 8 & 3) // 0: bytes, 1: halves, 2: floats
#define TEXTURE_COMPONENT_SHIFT 8
#define TEXTURE_LINEAR 1024            // bytes stand for 0 to 1 evenly, not as in sRGB
#define TEXTURE_OF_FACES 2048          // an attribute of faces, not of vertices

// What bytes of texels stand for: 256 of sRGB, 256 evenly.
#define BYTE_VALUES 512

// A table of the share of light that single scattering sends on: a row of cosines for each azimuth.
#define ENERGY_COSINES 129
#define ENERGY_AZIMUTHS 17
#define ENERGY_TABLE_SIZE (ENERGY_COSINES * (HAS(anisotropy) ? ENERGY_AZIMUTHS : 1))

// a, b, c and extra as the emitter's own header says; pmf: probability of picking this row, its share of the power where
// there is a light tree; area of what is chosen by area. Lengths are in the device's units (host/flatten/scene_frame.h).
#define LIGHT_FIELDS(X)                                                                            \
    X(int, kind)                                                                                   \
    X(float, ax) X(float, ay) X(float, az)                                                         \
    X(float, bx) X(float, by) X(float, bz)                                                         \
    X(float, cx) X(float, cy) X(float, cz)                                                         \
    X(float, r) X(float, g) X(float, b) X(float, pmf) X(float, area) X(float, extra)

// A node of the light tree: lights within a sphere, whose axes lie in a cone. Siblings stand side by side, the left one at an
// even place; nodes 0 and 1 are the children of the root.
#define LIGHT_NODE_FIELDS(X)                                                                       \
    X(float, cx) X(float, cy) X(float, cz) X(float, radius)                                        \
    X(float, ax) X(float, ay) X(float, az)                                                         \
    X(float, spread)                          /* -cosine of the angle from the axis that they shine within; 2: anywhere */ \
    X(float, intensity)                       /* largest, radiance x area, of all lights together */ \
    X(int, fixed)                             /* 1: `intensity` is the importance, for any point */ \
    X(int, child)                             /* the left of its children; a leaf: ~light row */   \
    X(int, parent)                            /* -1: the root */                                    \
    X(int, unused0) X(int, unused1) X(int, unused2) X(int, unused3)

// All that scenes store: the struct of lanes, its fields, how many they are.
#define RECORDS(X)                                                                                 \
    X(IndexedPrimitive, INDEXED_PRIMITIVE_FIELDS, 7) X(Shape, SHAPE_FIELDS, 8)                     \
    X(Material, MATERIAL_FIELDS, 16) X(Lobe, LOBE_FIELDS, 8)                                       \
    X(MaterialTextures, MATERIAL_TEXTURES_FIELDS, 8) X(Texture, TEXTURE_FIELDS, 16)                \
    X(Light, LIGHT_FIELDS, 16) X(LightNode, LIGHT_NODE_FIELDS, 16)
// And what is made of that.
#define MADE_OF_RECORDS(X) X(Primitive, PRIMITIVE_FIELDS, 11) X(Vertex, VERTEX_FIELDS, 15)
#define RECORD_DECLARE(Struct, FIELDS, words)                                                      \
    typedef struct { FIELDS(FIELD_DECLARE) } Struct##Record;                                       \
    LAYOUT(Struct##Record, 4 * (words));
RECORDS(RECORD_DECLARE)
MADE_OF_RECORDS(RECORD_DECLARE)

// Sampling a reconstruction filter: one of its equally likely bins along one axis. It starts at x (pixels from the centre), ends
// where the next one starts, and its samples have this weight (negative in a negative lobe).
typedef struct {
    float x, weight;
} FilterBin;
LAYOUT(FilterBin, 8);

// ------------------------------------------------------------------------------------------------------ BVH
#define BVH_WIDTH 16
#define BVH_STACK 512 // children that may wait while a ray walks the tree; the builder keeps to it

// Boxes are larger than what they hold, or count as larger, by this much of a primitive's longest side: see intersect.h.
#define BOX_MARGIN 1.9073486328125e-6f // 2^-19

// Children's boxes as rows of 16: low x, high x, low y, high y, low z, high z. An absent child's box is empty
// (low = +inf, high = -inf). child >= 0: a node; child < 0: BVH_LEAF_CODE(line, form), a leaf from that line of the leaves on, whose
// form is BVH_PATCH or the geometry kind of a BvhLeaf. There is room for more: instances, curves, triangles with masks.
typedef struct {
    float bounds[6][BVH_WIDTH];
    int child[BVH_WIDTH];
} BvhNode;
LAYOUT(BvhNode, 448);

// Leaves are of two sizes, so that they are counted in lines of a cache.
typedef struct {
    int words[16];
} BvhLine;
LAYOUT(BvhLine, 64);

// Up to 16 primitives of one kind, rows ax ay az bx by bz cx cy cz. Absent ones are all zero
// with primitive -1, triangles not a number (nothing of either is ever hit). A sphere has its radius in row bx; a
// cylinder has its axis unit, its radius in row cx, its height in cy. One
// bit of the primitives is not part of their numbers: of leaves of triangles, bit BVH_SIZE_BIT of word k is bit k of the upper
// half of a float, the longest side of any of their boxes, rounded up; of others it is PRIMITIVE_FLIPPED.
typedef struct {
    float rows[9][BVH_WIDTH];
    int primitive[BVH_WIDTH];
} BvhLeaf;
LAYOUT(BvhLeaf, 640);
#define BVH_SIZE_BIT 30
#define BVH_LEAF_NUMBER(word) ((word) & ~(1 << BVH_SIZE_BIT))

// Up to 16 triangles that have no more than 16 corners between them, as in nearly all leaves of a mesh: x, y, z of the corners,
// and a word a triangle. Its bits 0 to 11 are its corners, 4 bits each (all 0: absent); bits 12 to 29 its number as
// a primitive, less a base; bit 30 as in a BvhLeaf; bit 31 of word k is bit k of base >> BVH_PATCH_BASE.
typedef struct {
    int triangle[BVH_WIDTH];
    float corner[3][BVH_WIDTH];
} BvhPatch;
LAYOUT(BvhPatch, 256);

#define BVH_FORM_BITS 3
#define BVH_LEAF_CODE(line, form) (~(((line) << BVH_FORM_BITS) | (form)))
#define BVH_LEAF_LINE(code) (~(code) >> BVH_FORM_BITS)
#define BVH_LEAF_FORM(code) (~(code) & ((1 << BVH_FORM_BITS) - 1))
#define BVH_PATCH 7 // geometry kinds count from 0
#define BVH_PATCH_CORNERS 12
#define BVH_PATCH_NUMBERS 18
#define BVH_PATCH_BASE 13

// Of all triangles of a tree: the largest side of a box around them, and the longest side, along an axis, of one whose own box is
// not larger than itself.
typedef struct {
    float extent, side;
} TreeSizes;
LAYOUT(TreeSizes, 8);

// --------------------------------------------------------------------------------------------------- camera
// A ray through the pixel position (x, y), in pixels from the top left corner of the full film:
// direction = corner + x * step_x + y * step_y, whose length along the optical axis is 1.
// If HAS(far_camera), rays begin on a plane that is `start` from the lens: the origin is where the axis meets that, the position
// (axis_x, axis_y) of the film, near_clip and far_clip count from there. Otherwise these are 0.
// If HAS(orthographic) and `parallel` is 1, it is origin + x * step_x + y * step_y that moves with the position, the direction is the same unit
// vector for all, and `start` is how far before their origins, if HAS(far_camera), the near plane is (0 otherwise).
#define CAMERA_FIELDS(X)                                                                           \
    X(float, ox) X(float, oy) X(float, oz)    /* origin */                                         \
    X(float, dx) X(float, dy) X(float, dz)    /* corner direction */                               \
    X(float, ux) X(float, uy) X(float, uz)    /* step_x */                                         \
    X(float, vx) X(float, vy) X(float, vz)    /* step_y */                                         \
    X(float, lx) X(float, ly) X(float, lz)    /* lens axis x, aperture radius long */              \
    X(float, mx) X(float, my) X(float, mz)    /* lens axis y, aperture radius long */              \
    X(float, near_clip) X(float, far_clip) X(float, focus_distance)                                \
    X(float, axis_x) X(float, axis_y) X(float, start)                                              \
    X(float, lens_shift)                      /* start / focus_distance */                         \
    X(float, fx) X(float, fy) X(float, fz)    /* centre of the lens */                             \
    X(float, clear_share)                     /* 1 - the near plane's distance / start */          \
    X(float, parallel)
typedef struct { CAMERA_FIELDS(FIELD_DECLARE) } CameraRecord;
LAYOUT(CameraRecord, 120);

#define AOV_LIMIT 8

// What all kernels of a render are told.
#define RENDER_FIELDS(X)                                                                           \
    X(int, film_width) X(int, film_height)    /* full film, pixels */                               \
    X(int, pixel_stride)                      /* from one row's pixel numbers to the next one's */  \
    X(int, sample_border)                     /* 1: samples beyond the edge of the film count */    \
    X(int, window_x) X(int, window_y) X(int, window_width) X(int, window_height) /* sampled */     \
    X(int, block_x) X(int, block_y)           /* pixel in the corner of the first block */          \
    X(int, blocks_x)                          /* blocks in a row of the window */                   \
    X(int, seed)                                                                                   \
    X(int, replicate_bits)                    /* the pattern is 2^these */                          \
    X(int, max_depth)                         /* edges from the camera; INT_MAX without limit */    \
    X(int, rr_depth)                                                                               \
    X(int, sky_light) X(int, sky_texture)     /* rows of the light around everything and of its image, -1: none */ \
    X(int, sky_covers)                        /* 1: there is a sky, and it counts for alpha */       \
    X(int, filter_bins)                       /* of filter_table */                                 \
    X(int, filter_reach)                      /* pixels on each side that a sample counts for */    \
    X(int, state_stride)                      /* floats between two fields of the path state */     \
    X(int, result_stride)                     /* floats between two channels of the results */     \
    X(int, film_stride)                       /* words between two digits of the film */           \
    X(int, segment_size)                      /* path slots owned by one work-item */               \
    X(int, segment_stride)                    /* their entries in the path state, with padding */   \
    X(int, aov_channels)                                                                           \
    X(int, camera_root) X(int, root) X(int, blocking_root) X(int, clear_root) // of all; what shadow rays do not get through, and do
typedef struct {
    CameraRecord camera;
    RENDER_FIELDS(FIELD_DECLARE)
    TreeSizes tree_sizes;      // of all trees
    int aov_offset[AOV_LIMIT]; // AOV_CHANNEL of each kind's first, -1: not asked for
} RenderParams;
LAYOUT(RenderParams, 120 + 32 * 4 + AOV_LIMIT * 4);

// Pixels are sampled and summed up in square blocks.
#define BLOCK_SHIFT 2
#define BLOCK_SIDE (1 << BLOCK_SHIFT)
#define BLOCK_PIXELS (BLOCK_SIDE * BLOCK_SIDE)
// Where the k-th pixel of a block lies in it, counted row by row.
#define BLOCK_COLUMN(k) ((k) & (BLOCK_SIDE - 1))
#define BLOCK_ROW(k) ((k) >> BLOCK_SHIFT)

// A block's samples go to a tile of the film: the block, and around it as many pixels as the filter reaches. Its cells, row by
// row, are padded to whole packets.
#define FILTER_REACH_LIMIT 4
#define TILE_SIDE(reach) (BLOCK_SIDE + 2 * (reach))
#define TILE_CELLS(reach) ((TILE_SIDE(reach) * TILE_SIDE(reach) + 15) / 16 * 16)

// So many samples of a block are added up before the film gets their sum: waves hold a multiple of them. Digits of a sum there
// (exact_sum.h), and intervals a pixel of a filter's tabulated values; between them they are interpolated.
#define FILM_SAMPLES 16
#define EXACT_WORDS 10
#define FILTER_INTERVALS 1024

// clang-format on

#endif
