// The texels of all images that textures look at, in one buffer.
#pragma once

#include "host/flatten/texture_rows.h"

#include <cstddef>
#include <span>
#include <vector>

namespace parhelion {

/// An image, which several textures may look at.
struct ImageTexels {
    const BitmapTexture* bitmap;
    std::size_t first; ///< word

    std::size_t words() const { return (bitmap->source.layout.bytes() + 3) / 4; }
    std::span<std::byte> in(LargeVector<int>& texels) const {
        return std::as_writable_bytes(std::span(texels))
            .subspan(4 * first, bitmap->source.layout.bytes());
    }
};

/// One behind the other, and of each texture which it looks at; -1: none.
struct Images {
    std::vector<ImageTexels> images;
    std::vector<int> of_row;
};

/// Components are read three at a time, of a last grey texel as well.
inline constexpr std::size_t spare_words = 3;

/// Throws InputError for more words of texels than the device reads.
void check_words(const Scene& scene, std::size_t words);

Images place_images(const Scene& scene, const TextureRows& rows);

/// Into `texels`, and spare_words behind them; whence they are. Those of files that `before`, which
/// may be null, has and that have not changed since are taken from there. Throws InputError for an
/// image that cannot be read; of several the first is told of.
std::vector<ImageOrigin> read_images(const std::vector<ImageTexels>& images, DeviceScene* before,
                                     LargeVector<int>& texels);

} // namespace parhelion
