// Every struct that crosses the bus and every field of it, as a list for both languages:
// LAYOUT_TYPE(type) and LAYOUT_FIELD(type, field) are the including file's.

// The list below is a table.
// clang-format off
#define PRIMITIVE_LAYOUT(type, name) LAYOUT_FIELD(IndexedPrimitiveRecord, name)
#define SHAPE_LAYOUT(type, name) LAYOUT_FIELD(ShapeRecord, name)
#define MATERIAL_LAYOUT(type, name) LAYOUT_FIELD(MaterialRecord, name)
#define LIGHT_LAYOUT(type, name) LAYOUT_FIELD(LightRecord, name)
#define LIGHT_NODE_LAYOUT(type, name) LAYOUT_FIELD(LightNodeRecord, name)
#define CAMERA_LAYOUT(type, name) LAYOUT_FIELD(CameraRecord, name)
#define RENDER_LAYOUT(type, name) LAYOUT_FIELD(RenderParams, name)

#define LAYOUTS                                                                                    \
    LAYOUT_TYPE(IndexedPrimitiveRecord)                                                            \
    INDEXED_PRIMITIVE_FIELDS(PRIMITIVE_LAYOUT)                                                     \
    LAYOUT_TYPE(ShapeRecord)                                                                       \
    SHAPE_FIELDS(SHAPE_LAYOUT) LAYOUT_TYPE(MaterialRecord) MATERIAL_FIELDS(MATERIAL_LAYOUT)      \
        LAYOUT_TYPE(LightRecord) LIGHT_FIELDS(LIGHT_LAYOUT) LAYOUT_TYPE(LightNodeRecord) LIGHT_NODE_FIELDS(LIGHT_NODE_LAYOUT) LAYOUT_TYPE(FilterBin)          \
            LAYOUT_FIELD(FilterBin, x) LAYOUT_FIELD(FilterBin, weight) LAYOUT_TYPE(BvhNode)        \
                LAYOUT_FIELD(BvhNode, bounds) LAYOUT_FIELD(BvhNode, child) LAYOUT_TYPE(BvhLeaf)    \
                    LAYOUT_FIELD(BvhLeaf, rows) LAYOUT_FIELD(BvhLeaf, primitive)                   \
                    LAYOUT_TYPE(BvhLine) LAYOUT_FIELD(BvhLine, words) LAYOUT_TYPE(BvhPatch)        \
                    LAYOUT_FIELD(BvhPatch, triangle) LAYOUT_FIELD(BvhPatch, corner)                \
                        LAYOUT_TYPE(CameraRecord) CAMERA_FIELDS(CAMERA_LAYOUT)                     \
                            LAYOUT_TYPE(RenderParams) LAYOUT_FIELD(RenderParams, camera)           \
                                RENDER_FIELDS(RENDER_LAYOUT)                                       \
                                    LAYOUT_FIELD(RenderParams, aov_offset) LAYOUT_TYPE(WaveParams) \
                                        LAYOUT_FIELD(WaveParams, block_count)                      \
                                            LAYOUT_FIELD(WaveParams, sample_count)                 \
                                                LAYOUT_FIELD(WaveParams, film_first)               \
                                                    LAYOUT_TYPE(WaveBlock)                         \
                                                        LAYOUT_FIELD(WaveBlock, block)             \
                                                            LAYOUT_FIELD(WaveBlock, first_sample)
