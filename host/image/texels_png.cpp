// PNG files as texels, through libpng.
#include "host/image/texel_formats.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <vector>

namespace parhelion {

namespace {

/// Deflate makes no more than 258 bytes of two bits.
constexpr std::size_t largest_gain = 1032;

/// A file that libpng reads. The library jumps to where it is asked from when it finds something
/// wrong: functions that call it have nothing to destroy.
class PngReader {
public:
    explicit PngReader(const ImageBytes& file) : file_(file), left_(file.bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            file.refuse("not enough memory to read it");
        }
        png_set_read_fn(png_, this, read_some);
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // what is too large, we say
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    void read_header() {
        if (setjmp(png_jmpbuf(png_)) != 0) refuse();
        png_read_info(png_, info_);
    }
    /// Takes memory for a row.
    void prepare_rows() {
        if (setjmp(png_jmpbuf(png_)) != 0) refuse();
        set_transforms();
        png_read_update_info(png_, info_);
    }
    /// `rows`: where each begins.
    void read_rows(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) refuse();
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
    }

    std::int64_t width() const { return png_get_image_width(png_, info_); }
    std::int64_t height() const { return png_get_image_height(png_, info_); }
    int channels() const { return png_get_channels(png_, info_); }
    int bits() const { return png_get_bit_depth(png_, info_); }
    std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }

private:
    /// To one or three components of 8 or 16 bits; alpha is left out as it is, not multiplied in.
    /// A gamma that the file tells of is not looked at, as in Mitsuba 3: colours are sRGB.
    void set_transforms() {
        png_set_expand(png_);
        png_set_strip_alpha(png_);
        if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    }
    [[noreturn]] void refuse() const {
        file_.refuse("cannot be read as PNG: " + std::string(message_));
    }
    static void on_error(png_structp png, png_const_charp message) {
        auto* const self = static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(self->message_, message, sizeof(self->message_) - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void read_some(png_structp png, png_bytep to, png_size_t count) {
        auto* const self = static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > self->left_.size()) png_error(png, "the file ends too early");
        std::copy_n(self->left_.data(), count, to);
        self->left_.remove_prefix(count);
    }

    const ImageBytes& file_;
    std::string_view left_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    char message_[128] = {};
};

} // namespace

bool is_png(const ImageBytes& file) { return file.bytes.starts_with("\x89PNG\r\n\x1a\n"); }

TexelLayout layout_of_png(const ImageBytes& file) {
    PngReader png(file);
    png.read_header();
    TexelLayout layout;
    set_size(file, png.width(), png.height(), layout);
    if (layout.texels() / 8 > largest_gain * file.bytes.size())
        file.refuse(size_text(layout.width, layout.height) + " are too many for " +
                    std::to_string(file.bytes.size()) + " bytes of file");
    png.prepare_rows();
    layout.channels = png.channels();
    layout.component = png.bits() == 16 ? TexelComponent::single : TexelComponent::byte;
    layout.srgb = true;
    return layout;
}

void read_png(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    PngReader png(file);
    png.read_header();
    png.prepare_rows();
    const std::size_t row_bytes = png.row_bytes();
    const bool wide = layout.component == TexelComponent::single;
    std::vector<std::uint16_t> words(wide ? layout.texels() * layout.channels : 0);
    std::vector<png_bytep> rows(layout.height);
    for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] = reinterpret_cast<png_bytep>(wide ? static_cast<void*>(words.data()) : to.data()) +
                  y * row_bytes;
    png.read_rows(rows.data());
    for (std::size_t i = 0; i < words.size(); ++i)
        put_float(to, i, static_cast<float>(words[i] / 65535.0));
}

} // namespace parhelion
