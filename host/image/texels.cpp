// Images as textures read them: the format is found by a file's content.
#include "host/image/texels.h"

#include "host/image/texel_formats.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>

namespace parhelion {

namespace {

struct TexelFormat {
    std::string_view name;
    bool (*is)(const ImageBytes&);
    TexelLayout (*layout)(const ImageBytes&);
    void (*read)(const ImageBytes&, const TexelLayout&, std::span<std::byte>);
};

#define FORMAT_ENTRY(name, id) TexelFormat{name, is_##id, layout_of_##id, read_##id},
constexpr std::array texel_formats{TEXEL_FORMATS(FORMAT_ENTRY)};
#undef FORMAT_ENTRY

const TexelFormat& format_of(const ImageBytes& file) {
    for (const TexelFormat& format : texel_formats)
        if (format.is(file)) return format;
    file.refuse("not an image of a known format (accepted: " + texel_format_names() + ")");
}

std::string content_of(const std::string& name) {
    std::error_code error;
    const auto size = std::filesystem::file_size(name, error);
    if (error) throw InputError(name + ": cannot be read: " + error.message());
    std::ifstream stream(name, std::ios::binary);
    std::string content(size, '\0');
    if (!stream.read(content.data(), static_cast<std::streamsize>(size)))
        throw InputError(name + ": cannot be read: " + std::strerror(errno));
    return content;
}

} // namespace

std::string texel_format_names() {
    std::string names;
    for (const TexelFormat& format : texel_formats)
        names += (names.empty() ? "" : ", ") + std::string(format.name);
    return names;
}

std::string size_text(std::int64_t width, std::int64_t height) {
    return std::to_string(width) + " x " + std::to_string(height) + " texels";
}

void set_size(const ImageBytes& file, std::int64_t width, std::int64_t height,
              TexelLayout& layout) {
    constexpr std::int64_t longest = longest_texel_side;
    const bool sides = width > 0 && height > 0 && width <= longest && height <= longest;
    if (!sides || static_cast<std::size_t>(width * height) > most_texels)
        file.refuse(size_text(width, height) + " (accepted: sides of 1 to " +
                    std::to_string(longest) + ", " + std::to_string(most_texels) +
                    " texels in all)");
    layout.width = static_cast<int>(width), layout.height = static_cast<int>(height);
}

TexelLayout layout_of_texels(std::string_view bytes, const std::string& name) {
    const ImageBytes file{bytes, name};
    return format_of(file).layout(file);
}

void parse_texels(std::string_view bytes, const std::string& name, const TexelLayout& layout,
                  std::span<std::byte> to) {
    const ImageBytes file{bytes, name};
    const TexelFormat& format = format_of(file);
    if (format.layout(file) != layout || to.size() != layout.bytes())
        file.refuse("is no longer what it was when it was opened");
    format.read(file, layout, to);
}

TexelSource open_texels(const std::string& file) {
    const TexelLayout layout = layout_of_texels(content_of(file), file);
    return {file, layout, [file, layout](std::span<std::byte> to) {
                parse_texels(content_of(file), file, layout, to);
            }};
}

} // namespace parhelion
