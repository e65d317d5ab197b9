// What every kernel starts from: the shared maths, the buffers and the common parameters.
#ifndef PARHELION_DEVICE_H
#define PARHELION_DEVICE_H

#include "shared/features.h"
#include "shared/types.h"

#include "shared/shared.h"

#include "device/buffers.h"

#include "device/bounds.h"

#define SCENE_PARAMETER(type, name) global const type *restrict name,
// Work is done in Reals: the float of the list of work buffers stands for one lane of them.
#define WORK_float Scalar
#define WORK_int int
#define WORK_uint uint
#define WORK_ulong ulong
#define WORK_WaveBlock WaveBlock
#define WORK_PARAMETER(type, name) global WORK_##type *restrict name,
#define KERNEL_PARAMETERS                                                                          \
    SCENE_BUFFERS(SCENE_PARAMETER)                                                                 \
    WORK_BUFFERS(WORK_PARAMETER)                                                                   \
    const RenderParams params, const WaveParams wave, const int depth CHECKED_PARAMETERS

FN int wave_paths(WaveParams w) { return w.block_count * w.sample_count * BLOCK_PIXELS; }

#endif
