// What bytes of texels stand for.
#include "host/flatten/texture_records.h"
#include "host/image/srgb.h"

namespace parhelion {

std::vector<float> make_byte_values() {
    std::vector<float> values(BYTE_VALUES);
    for (int byte = 0; byte < 256; byte++) {
        values[byte] = static_cast<float>(srgb_decode(byte / 255.0));
        values[256 + byte] = static_cast<float>(byte / 255.0);
    }
    return values;
}

} // namespace parhelion
