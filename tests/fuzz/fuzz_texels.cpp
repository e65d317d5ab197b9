// Images as textures read them, of all formats.
#include "host/image/texels.h"
#include "property.h"
#include "targets.h"

#include <vector>

int parhelion::fuzz::fuzz_texels(const std::uint8_t* data, std::size_t size) {
    return answer_or_refusal([&] {
        // A name by which what no other format knows is a TGA file.
        const char* const name = "image.tga";
        const TexelLayout layout = layout_of_texels(as_text(data, size), name);
        promise(layout.width > 0 && layout.height > 0 && layout.texels() <= most_texels,
                "a size is within its limits");
        promise(layout.channels == 1 || layout.channels == 3, "texels have 1 or 3 components");
        if (layout.bytes() > (std::size_t{1} << 22)) return; // for the fuzzer's speed
        std::vector<std::byte> texels(layout.bytes());
        parse_texels(as_text(data, size), name, layout, texels);
    });
}
