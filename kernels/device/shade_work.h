// What the steps of shading work with.
#ifndef PARHELION_SHADE_WORK_H
#define PARHELION_SHADE_WORK_H

#include "device/results.h"
#include "device/scene_tables.h"

typedef struct {
    SceneTables scene;
    const RenderParams* params;
    Results results;
    int depth; // of the vertices: how many lie before them
} ShadeWork;

#endif
