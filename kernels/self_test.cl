// Self-test: a kernel whose results are known exactly, to see whether a device computes at all.
#include "device/device.h"

/// out[i] = i * i / 4 + 1, exact in single precision for i < 2048; element i + n is sqrt(i * i) =
/// i.
kernel void self_test(global float* out, int n) {
    int i = get_global_id(0);
    float x = (float)i;
    out[i] = x * x * .25f + 1.f;
    out[i + n] = sqrt(x * x);
}
