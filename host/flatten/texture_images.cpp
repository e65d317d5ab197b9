// The texels of all images that textures look at, in one buffer.
#include "host/flatten/texture_images.h"

#include "host/error.h"
#include "host/image/srgb.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <utility>

namespace parhelion {
namespace {

/// Values of 16 bits of sRGB become linear when they are read: floats have room for them.
bool decoded_when_read(const BitmapTexture& bitmap) {
    const TexelLayout& layout = bitmap.source.layout;
    return layout.srgb && !bitmap.raw && layout.component == TexelComponent::single;
}

void read_image(const ImageTexels& image, LargeVector<int>& texels) {
    std::span<std::byte> bytes = image.in(texels);
    image.bitmap->source.read(bytes);
    if (!decoded_when_read(*image.bitmap)) return;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(float)) {
        float value = 0;
        std::memcpy(&value, &bytes[at], sizeof value);
        value = static_cast<float>(srgb_decode(value));
        std::memcpy(&bytes[at], &value, sizeof value);
    }
}

/// Before they are read.
std::vector<ImageOrigin> origins_of(const std::vector<ImageTexels>& images) {
    std::vector<ImageOrigin> origins;
    origins.reserve(images.size());
    for (const ImageTexels& image : images) {
        const TexelSource& source = image.bitmap->source;
        origins.push_back({source.name, source.layout, decoded_when_read(*image.bitmap),
                           file_stamp(source.name), image.first});
    }
    return origins;
}

/// The texels of `wanted` in `before`; empty where they are not there.
std::span<const int> kept_texels(const ImageOrigin& wanted, std::size_t words,
                                 const DeviceScene& before) {
    if (!wanted.stamp) return {};
    for (ImageOrigin kept : before.images) {
        const std::size_t first = std::exchange(kept.first, wanted.first);
        if (kept == wanted) return std::span(before.texels).subspan(first, words);
    }
    return {};
}

} // namespace

void check_words(const Scene& scene, std::size_t words) {
    // Bytes have numbers of 32 bits, those that are read behind the last as well.
    constexpr std::size_t most = (std::size_t{1} << 30) - spare_words;
    if (words > most)
        throw InputError(fmt::format("{}: its textures hold {} bytes; the device reads at most {}",
                                     scene.file, 4 * words, 4 * most));
}

Images place_images(const Scene& scene, const TextureRows& rows) {
    Images placed;
    std::map<std::pair<std::string, bool>, int> known;
    std::size_t end = 0;
    for (const auto& texture : rows.textures()) {
        const auto* bitmap = std::get_if<BitmapTexture>(&texture->kind);
        placed.of_row.push_back(-1);
        if (!bitmap) continue;
        auto [entry, added] = known.try_emplace({bitmap->source.name, decoded_when_read(*bitmap)},
                                                static_cast<int>(placed.images.size()));
        placed.of_row.back() = entry->second;
        if (!added) continue;
        placed.images.push_back({bitmap, end});
        end += placed.images.back().words();
    }
    check_words(scene, end);
    return placed;
}

std::vector<ImageOrigin> read_images(const std::vector<ImageTexels>& images, DeviceScene* before,
                                     LargeVector<int>& texels) {
    if (images.empty()) return {};
    std::vector<ImageOrigin> origins = origins_of(images);
    const bool all_kept = before && before->images == origins &&
                          std::all_of(origins.begin(), origins.end(),
                                      [](const ImageOrigin& o) { return o.stamp.has_value(); });
    if (all_kept) { // without memory for both
        texels = std::move(before->texels);
        before->images.clear();
    }
    std::size_t words = images.back().first + images.back().words();
    texels.resize(words + spare_words);
    std::fill_n(texels.end() - spare_words, spare_words, 0);
    if (all_kept) return origins;
    std::vector<std::exception_ptr> errors(images.size());
    parallel_for(images.size(), [&](std::size_t n) {
        try {
            std::span<const int> kept;
            if (before) kept = kept_texels(origins[n], images[n].words(), *before);
            if (kept.empty())
                read_image(images[n], texels);
            else
                std::copy(kept.begin(), kept.end(),
                          texels.begin() + std::ptrdiff_t(images[n].first));
        } catch (...) {
            errors[n] = std::current_exception();
        }
    });
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
    return origins;
}

} // namespace parhelion
