// Tone mapping to 8-bit sRGB.
#include "host/image/png.h"

#include "host/error.h"
#include "host/image/png_file.h"
#include "host/image/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>

namespace parhelion {

namespace {

/// Which channels of an image its preview shows.
struct PreviewSource {
    std::array<std::size_t, 3> planes{};
    bool is_xyz = false;

    bool is_grey() const { return planes[0] == planes[1]; }
};

PreviewSource preview_source(const std::string& file, const Image& frame) {
    const auto planes = [&](const std::array<const char*, 3>& names) {
        std::array<std::size_t, 3> found{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Channel* channel = find_channel(frame, names[i]);
            if (!channel) return std::optional<std::array<std::size_t, 3>>();
            found[i] = static_cast<std::size_t>(channel - frame.channels.data());
        }
        return std::optional(found);
    };
    if (const auto rgb = planes({"R", "G", "B"})) return {*rgb, false};
    if (const auto xyz = planes({"X", "Y", "Z"})) return {*xyz, true};
    if (const auto grey = planes({"Y", "Y", "Y"})) return {*grey, false};
    throw InputError(file + ": a PNG preview needs channels R G B, X Y Z or Y");
}

std::uint8_t to_byte(double linear) {
    return static_cast<std::uint8_t>(
        std::lround(255.0 * srgb_encode(std::clamp(linear, 0.0, 1.0))));
}

/// Appends interleaved bytes.
void tone_map(const PreviewSource& source, const Image& band, double exposure,
              std::vector<std::uint8_t>& bytes) {
    const double scale = std::exp2(exposure);
    const auto value = [&](int c, std::size_t i) {
        return static_cast<double>(band.channels[source.planes[c]].values[i]);
    };
    for (std::size_t i = 0; i < band.pixel_count(); ++i) {
        std::array<double, 3> rgb{value(0, i), value(1, i), value(2, i)};
        if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2])) {
            rgb = {1.0, 0.0, 1.0};
        } else {
            if (source.is_xyz) rgb = transform(xyz_to_srgb, rgb);
            for (double& linear : rgb)
                linear *= scale;
        }
        for (const double linear : rgb)
            bytes.push_back(to_byte(linear));
    }
}

/// Notes what is not finite in a plane of a band.
void add_misfits(const Channel& channel, const Image& band, Misfits& misfits) {
    for (int y = 0; y < band.height; ++y)
        for (int x = 0; x < band.width; ++x)
            if (const float value = channel.values[band.index(x, y)]; !std::isfinite(value))
                misfits.add(band.offset_x + x, band.offset_y + y, value, false);
}

PngTexts texts_of(const Image& image) {
    PngTexts texts;
    texts.reserve(image.metadata.size());
    for (const auto& [name, value] : image.metadata)
        texts.emplace_back(name,
                           std::visit([](const auto& v) { return fmt::format("{}", v); }, value));
    return texts;
}

void write_bytes(const std::string& file, const Image& image,
                 const std::vector<std::uint8_t>& bytes, Existing existing) {
    PendingFile pending(file, existing);
    std::FILE* stream = std::fopen(pending.temporary_name().c_str(), "wb");
    if (!stream) throw OutputError(file + ": cannot write: " + std::strerror(errno));
    const std::string message =
        write_png_stream(stream, image.width, image.height, bytes, texts_of(image));
    const bool closed = std::fclose(stream) == 0;
    if (!message.empty()) throw OutputError(file + ": cannot write: " + message);
    if (!closed) throw OutputError(file + ": cannot write: " + std::strerror(errno));
    pending.commit();
}

} // namespace

std::vector<Misfits> write_png(const std::string& file, const ImageRows& image, double exposure,
                               Existing existing) {
    if (!std::isfinite(exposure)) throw std::invalid_argument("exposure must be finite");
    const Image& frame = image.frame();
    const PreviewSource source = preview_source(file, frame);
    std::vector<Misfits> misfits;
    for (std::size_t i = 0; i < (source.is_grey() ? 1u : 3u); ++i)
        misfits.push_back({.channel = frame.channels[source.planes[i]].name});
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * frame.pixel_count());
    for (int first = 0; first < frame.height; first += image.band_rows()) {
        const Image band = image.rows(first, std::min(image.band_rows(), frame.height - first));
        tone_map(source, band, exposure, bytes);
        for (std::size_t i = 0; i < misfits.size(); ++i)
            add_misfits(band.channels[source.planes[i]], band, misfits[i]);
    }
    write_bytes(file, frame, bytes, existing);
    std::erase_if(misfits, [](const Misfits& plane) { return plane.count() == 0; });
    return misfits;
}

} // namespace parhelion
