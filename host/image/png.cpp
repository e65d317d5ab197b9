// Tone mapping to 8-bit sRGB and writing through libpng.
#include "host/image/png.h"

#include "host/error.h"
#include "host/image/srgb.h"

#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace parhelion {

namespace {

struct PreviewSource {
    std::array<const Channel*, 3> planes{};
    bool is_xyz = false;
};

PreviewSource preview_source(const std::string& file, const Image& image) {
    const auto plane = [&](const char* name) { return find_channel(image, name); };
    const auto complete = [](const PreviewSource& s) {
        return s.planes[0] && s.planes[1] && s.planes[2];
    };
    const PreviewSource rgb{{plane("R"), plane("G"), plane("B")}, false};
    if (complete(rgb)) return rgb;
    const PreviewSource xyz{{plane("X"), plane("Y"), plane("Z")}, true};
    if (complete(xyz)) return xyz;
    const PreviewSource grey{{plane("Y"), plane("Y"), plane("Y")}, false};
    if (complete(grey)) return grey;
    throw InputError(file + ": a PNG preview needs channels R G B, X Y Z or Y");
}

std::uint8_t to_byte(double linear) {
    return static_cast<std::uint8_t>(
        std::lround(255.0 * srgb_encode(std::clamp(linear, 0.0, 1.0))));
}

/// Interleaved bytes.
std::vector<std::uint8_t> tone_map(const PreviewSource& source, std::size_t count,
                                   double exposure) {
    const double scale = std::exp2(exposure);
    std::vector<std::uint8_t> bytes(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 3> rgb{source.planes[0]->values[i], source.planes[1]->values[i],
                                  source.planes[2]->values[i]};
        if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2])) {
            rgb = {1.0, 0.0, 1.0};
        } else {
            if (source.is_xyz) rgb = transform(xyz_to_srgb, rgb);
            for (double& value : rgb)
                value *= scale;
        }
        for (int c = 0; c < 3; ++c)
            bytes[3 * i + c] = to_byte(rgb[c]);
    }
    return bytes;
}

std::vector<Misfits> misfits_of(const PreviewSource& source, const Image& image) {
    std::vector<Misfits> all;
    for (std::size_t plane = 0; plane < source.planes.size(); ++plane) {
        const Channel& channel = *source.planes[plane];
        if (plane > 0 && &channel == source.planes[0]) break; // grey
        Misfits misfits{.channel = channel.name};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                if (const float value = channel.values[image.index(x, y)]; !std::isfinite(value))
                    misfits.add(image.offset_x + x, image.offset_y + y, value, false);
        if (misfits.count() > 0) all.push_back(misfits);
    }
    return all;
}

void write_bytes(const std::string& file, const Image& image,
                 const std::vector<std::uint8_t>& bytes, Existing existing) {
    PendingFile pending(file, existing);
    std::FILE* stream = std::fopen(pending.temporary_name().c_str(), "wb");
    if (!stream) throw OutputError(file + ": cannot write: " + std::strerror(errno));
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_RGB;
    const bool written = png_image_write_to_stdio(&png, stream, 0, bytes.data(), 0, nullptr) != 0;
    const std::string message = png.message;
    png_image_free(&png);
    const bool closed = std::fclose(stream) == 0;
    if (!written) throw OutputError(file + ": cannot write: " + message);
    if (!closed) throw OutputError(file + ": cannot write: " + std::strerror(errno));
    pending.commit();
}

} // namespace

std::vector<Misfits> write_png(const std::string& file, const Image& image, double exposure,
                               Existing existing) {
    if (!std::isfinite(exposure)) throw std::invalid_argument("exposure must be finite");
    const PreviewSource source = preview_source(file, image);
    write_bytes(file, image, tone_map(source, image.pixel_count(), exposure), existing);
    return misfits_of(source, image);
}

} // namespace parhelion
