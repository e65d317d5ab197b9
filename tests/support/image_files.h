// Small image files, made byte by byte as their formats say, or by the libraries that write them.
#pragma once

#include "host/image/exr.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <jpeglib.h> // after cstdio, which it needs
#include <png.h>
#include <unistd.h>

namespace parhelion::test {

/// Rows of red, green, blue, the top row first.
struct TestImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    std::uint8_t at(int x, int y, int c) const { return rgb[3 * (y * width + x) + c]; }
};

/// Three columns, two rows, no two values alike.
inline TestImage six_colors() {
    TestImage image{3, 2, {}};
    for (int i = 0; i < 18; i++)
        image.rgb.push_back(static_cast<std::uint8_t>(5 + 13 * i));
    return image;
}

inline void add_bytes(std::string& to, std::initializer_list<int> bytes) {
    for (int byte : bytes)
        to += static_cast<char>(byte);
}
inline void add_word32(std::string& to, std::uint32_t word) {
    for (int k = 0; k < 4; k++)
        to += static_cast<char>(word >> 8 * k);
}

/// Uncompressed, from the bottom row up, 24 bits.
inline std::string bmp_of(const TestImage& image) {
    int row = (3 * image.width + 3) / 4 * 4;
    std::string file = "BM";
    add_word32(file, static_cast<std::uint32_t>(54 + row * image.height));
    add_word32(file, 0);
    add_word32(file, 54);
    for (int word : {40, image.width, image.height, 1 | 24 << 16, 0, 0, 0, 0, 0, 0})
        add_word32(file, static_cast<std::uint32_t>(word));
    for (int y = image.height - 1; y >= 0; y--) {
        std::string line;
        for (int x = 0; x < image.width; x++)
            add_bytes(line, {image.at(x, y, 2), image.at(x, y, 1), image.at(x, y, 0)});
        line.resize(row);
        file += line;
    }
    return file;
}

/// With a palette of 16 colours, each texel a different one.
inline std::string palette_bmp_of(const TestImage& image) {
    std::string file = "BM";
    add_word32(file, 0);
    add_word32(file, 0);
    add_word32(file, 54 + 64);
    for (int word : {40, image.width, -image.height, 1 | 4 << 16, 0, 0, 0, 0, 16, 0})
        add_word32(file, static_cast<std::uint32_t>(word));
    std::string palette;
    for (int n = 0; n < image.width * image.height; n++)
        add_bytes(palette, {image.rgb[3 * n + 2], image.rgb[3 * n + 1], image.rgb[3 * n], 0});
    palette.resize(64);
    file += palette;
    for (int n = 0; n < image.width * image.height; n += image.width) // three columns: two bytes
        add_bytes(file, {n << 4 | (n + 1), (n + 2) << 4, 0, 0});
    return file;
}

inline std::string tga_of(const TestImage& image, bool runs, bool from_top) {
    std::string file;
    add_bytes(file, {0, 0, runs ? 10 : 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, image.width, 0, image.height,
                     0, 24, from_top ? 32 : 0});
    for (int n = 0; n < image.height; n++) {
        int y = from_top ? n : image.height - 1 - n;
        if (runs) add_bytes(file, {image.width - 1});
        for (int x = 0; x < image.width; x++)
            add_bytes(file, {image.at(x, y, 2), image.at(x, y, 1), image.at(x, y, 0)});
    }
    return file;
}

/// One colour, as one run.
inline std::string tga_run(int count, std::array<int, 3> rgb) {
    std::string file;
    add_bytes(file, {0, 0,     10, 0, 0, 0,  0,  0,           0,      0,      0,
                     0, count, 0,  1, 0, 24, 32, 127 + count, rgb[2], rgb[1], rgb[0]});
    return file;
}

inline std::string pfm_of(int width, int height, const std::vector<float>& top_down, int channels) {
    std::string file = channels == 3 ? "PF\n" : "Pf\n";
    file += std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    auto row = static_cast<std::size_t>(width) * channels;
    for (std::size_t y = height; y-- > 0;)
        for (std::size_t k = 0; k < row; k++)
            add_word32(file, std::bit_cast<std::uint32_t>(top_down[y * row + k]));
    return file;
}

/// `texels`: mantissas and exponent of each. With runs, rows are at least 8 long.
inline std::string rgbe_of(int width, int height, const std::vector<std::array<int, 4>>& texels,
                           bool runs) {
    std::string file = "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                       std::to_string(height) + " +X " + std::to_string(width) + "\n";
    for (int y = 0; y < height; y++) {
        const auto* row = &texels[static_cast<std::size_t>(y) * width];
        if (!runs) {
            for (int x = 0; x < width; x++)
                add_bytes(file, {row[x][0], row[x][1], row[x][2], row[x][3]});
            continue;
        }
        add_bytes(file, {2, 2, width >> 8, width & 255});
        for (int c = 0; c < 4; c++) {
            // The first texel singly, then those that are as the second, then the rest.
            int same = 1;
            while (1 + same < width && row[1 + same][c] == row[1][c])
                same++;
            add_bytes(file, {1, row[0][c], 128 + same, row[1][c]});
            if (1 + same < width) add_bytes(file, {width - 1 - same});
            for (int x = 1 + same; x < width; x++)
                add_bytes(file, {row[x][c]});
        }
    }
    return file;
}

/// `format`: of libpng's simplified interface; 8 bits a component, or 16 with
/// PNG_FORMAT_FLAG_LINEAR.
inline std::string png_of(int width, int height, unsigned format, const void* values) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(width);
    png.height = static_cast<png_uint_32>(height);
    png.format = format;
    png_alloc_size_t bytes = 0;
    png_image_write_to_memory(&png, nullptr, &bytes, 0, values, 0, nullptr);
    std::string file(bytes, '\0');
    if (!png_image_write_to_memory(&png, file.data(), &bytes, 0, values, 0, nullptr))
        throw std::runtime_error(png.message);
    file.resize(bytes);
    return file;
}
inline std::string png_of(const TestImage& image) {
    return png_of(image.width, image.height, PNG_FORMAT_RGB, image.rgb.data());
}

/// One colour (or one grey), at the best quality.
inline std::string jpeg_of(int width, int height, const std::vector<std::uint8_t>& color) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* memory = nullptr;
    unsigned long bytes = 0; // NOLINT(google-runtime-int): the library's
    jpeg_mem_dest(&jpeg, &memory, &bytes);
    jpeg.image_width = static_cast<JDIMENSION>(width);
    jpeg.image_height = static_cast<JDIMENSION>(height);
    jpeg.input_components = static_cast<int>(color.size());
    jpeg.in_color_space = color.size() == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<std::uint8_t> row;
    for (int x = 0; x < width; x++)
        row.insert(row.end(), color.begin(), color.end());
    for (int y = 0; y < height; y++) {
        JSAMPROW line = row.data();
        jpeg_write_scanlines(&jpeg, &line, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string file(reinterpret_cast<const char*>(memory), bytes);
    jpeg_destroy_compress(&jpeg);
    std::free(memory); // NOLINT(cppcoreguidelines-no-malloc): it is the library's
    return file;
}

inline std::string exr_of(int width, int height, const std::vector<std::string>& channels,
                          const std::vector<float>& interleaved, ComponentFormat component) {
    Image image = make_image(width, height);
    add_layer(image, "", channels, interleaved);
    std::string name = (std::filesystem::temp_directory_path() / "parhelion_XXXXXX").string();
    int file = mkstemp(name.data());
    if (file < 0) throw std::runtime_error("no temporary file: " + name);
    close(file);
    static_cast<void>(write_exr(name, image, {component, Existing::replace}));
    std::ifstream stream(name, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::filesystem::remove(name);
    return bytes;
}

} // namespace parhelion::test
