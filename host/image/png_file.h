// PNG files: bytes and texts, through libpng.
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace parhelion {

/// Keyword (1 to 79 characters) and value (UTF-8) of what a PNG says of itself.
using PngTexts = std::vector<std::pair<std::string, std::string>>;

/// Writes 8-bit sRGB, three bytes a pixel, row by row from the top. Returns what libpng says is
/// wrong; nothing where all is written.
[[nodiscard]] std::string write_png_stream(std::FILE* stream, int width, int height,
                                           std::span<const std::uint8_t> bytes,
                                           const PngTexts& texts);

/// The text of that keyword that stands before the pixels of a file; nothing where there is none,
/// or no such file.
std::string png_attribute(const std::string& file, const std::string& keyword);

} // namespace parhelion
