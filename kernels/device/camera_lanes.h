// The camera of a render, the same in all lanes.
#ifndef PARHELION_CAMERA_LANES_H
#define PARHELION_CAMERA_LANES_H

FN Camera camera_lanes(CameraRecord record) {
    Camera c;
#define CAMERA_SPLAT(type, name) c.name = (Real)record.name;
    CAMERA_FIELDS(CAMERA_SPLAT)
    return c;
}

#endif
