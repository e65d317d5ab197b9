// Layout probe: where the device's compiler puts every field of every struct that crosses the bus.
#include "device/device.h"

/// Writes sizes and offsets in bytes in the order of LAYOUTS, then all words of the parameters as
/// they arrived by value.
kernel void layout_probe(global int* out, const RenderParams params, const WaveParams wave) {
    int n = 0;
#define LAYOUT_TYPE(type) out[n++] = (int)sizeof(type);
#define LAYOUT_FIELD(type, field)                                                                  \
    {                                                                                              \
        type x;                                                                                    \
        out[n++] = (int)((private char*)&x.field - (private char*)&x);                             \
    }
    LAYOUTS
    for (int i = 0; i < (int)(sizeof(RenderParams) / 4); i++)
        out[n++] = ((private const int*)&params)[i];
    for (int i = 0; i < (int)(sizeof(WaveParams) / 4); i++)
        out[n++] = ((private const int*)&wave)[i];
}
