// The list of image formats that textures are read from, and what their readers share.
#pragma once

#include "host/error.h"
#include "host/image/texels.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace parhelion {

/// A file's content.
struct ImageBytes {
    std::string_view bytes;
    std::string name;

    /// Throws InputError "name: what".
    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(name + ": " + what);
    }
};

// Name in messages; the function that recognises a file; its layout; its texels: of <id>, that is
// is_<id>, layout_of_<id> and read_<id>. Files are asked in this order; TGA has no mark of its own.
#define TEXEL_FORMATS(X)                                                                           \
    X("PNG", png)                                                                                  \
    X("JPEG", jpeg)                                                                                \
    X("OpenEXR", openexr) X("Radiance HDR", rgbe) X("BMP", bmp) X("PFM", pfm) X("TGA", tga)

#define DECLARE_FORMAT(name, id)                                                                   \
    bool is_##id(const ImageBytes& file);                                                          \
    TexelLayout layout_of_##id(const ImageBytes& file);                                            \
    void read_##id(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to);
TEXEL_FORMATS(DECLARE_FORMAT)
#undef DECLARE_FORMAT

/// Reads on from a place in a file; refuses what lies behind its end.
class ByteReader {
public:
    explicit ByteReader(const ImageBytes& file, std::size_t at = 0) : file_(file), at_(at) {}

    std::string_view take(std::size_t count) {
        if (at_ > file_.bytes.size() || count > file_.bytes.size() - at_)
            file_.refuse("ends before its last texel");
        at_ += count;
        return file_.bytes.substr(at_ - count, count);
    }
    std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
    /// Little-endian.
    std::uint32_t word16() {
        const std::uint32_t low = byte();
        return low | std::uint32_t{byte()} << 8;
    }
    std::uint32_t word32() {
        const std::uint32_t low = word16();
        return low | word16() << 16;
    }
    /// A line without its end.
    std::string_view line() {
        const std::size_t end = file_.bytes.find('\n', at_);
        if (end == std::string_view::npos) file_.refuse("ends within its header");
        const std::string_view text = take(end + 1 - at_);
        return text.substr(0, text.size() - 1);
    }
    std::size_t at() const { return at_; }

private:
    const ImageBytes& file_;
    std::size_t at_;
};

/// Puts a float where component `place` of an image of floats stands.
inline void put_float(std::span<std::byte> to, std::size_t place, float value) {
    std::memcpy(to.data() + place * sizeof(float), &value, sizeof(float));
}

/// "what" with numbers of a header: "12 x 5 texels".
std::string size_text(std::int64_t width, std::int64_t height);

/// A layout's sides, refused where they are empty or larger than is accepted.
void set_size(const ImageBytes& file, std::int64_t width, std::int64_t height, TexelLayout& layout);

} // namespace parhelion
