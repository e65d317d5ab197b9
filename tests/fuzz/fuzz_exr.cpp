// OpenEXR images.
#include "host/image/exr.h"
#include "property.h"
#include "targets.h"

int parhelion::fuzz::fuzz_exr(const std::uint8_t* data, std::size_t size) {
    return answer_or_refusal([&] {
        const Image image = parse_exr(as_text(data, size), "image.exr");
        promise(image.width > 0 && image.height > 0 && !image.channels.empty(), "there are pixels");
        for (const Channel& channel : image.channels)
            promise(channel.values.size() == image.pixel_count(), "channels are complete");
    });
}
