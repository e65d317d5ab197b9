// The device's view of a record: the same fields as types.h, one value a lane.

#define LANES_OF_float Real
#define LANES_OF_int Int
#define FIELD_LANES(type, name) LANES_OF_##type name;

#define RECORD_LANES(Struct, FIELDS, words)                                                        \
    typedef struct {                                                                               \
        FIELDS(FIELD_LANES)                                                                        \
    } Struct;
RECORDS(RECORD_LANES)
MADE_OF_RECORDS(RECORD_LANES)

typedef struct {
    CAMERA_FIELDS(FIELD_LANES)
} Camera;
