// The device's view of a 64-byte record: the same fields as types.h, one value a lane.

#define LANES_OF_float Real
#define LANES_OF_int Int
#define FIELD_LANES(type, name) LANES_OF_##type name;

typedef struct {
    PRIMITIVE_FIELDS(FIELD_LANES)
} Primitive;
typedef struct {
    VERTEX_FIELDS(FIELD_LANES)
} Vertex;
typedef struct {
    MATERIAL_FIELDS(FIELD_LANES)
} Material;
typedef struct {
    LIGHT_FIELDS(FIELD_LANES)
} Light;
typedef struct {
    LIGHT_NODE_FIELDS(FIELD_LANES)
} LightNode;
typedef struct {
    CAMERA_FIELDS(FIELD_LANES)
} Camera;
