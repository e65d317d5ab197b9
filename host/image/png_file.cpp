// PNG files: bytes and texts, through libpng.
#include "host/image/png_file.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <memory>

namespace parhelion {

namespace {

/// The library jumps to where it is asked from when it finds something wrong: functions that call
/// it have nothing to destroy.
class PngFile {
public:
    explicit PngFile(bool writes) : writes_(writes) {
        png_ = writes ? png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)
                      : png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
    }
    ~PngFile() {
        if (writes_)
            png_destroy_write_struct(&png_, &info_);
        else
            png_destroy_read_struct(&png_, &info_, nullptr);
    }
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    bool is_ready() const { return info_ != nullptr; }
    std::string message() const { return message_; }

    bool write(std::FILE* stream, png_uint_32 width, png_uint_32 height, png_const_bytep bytes,
               png_const_textp texts, int text_count) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_init_io(png_, stream);
        png_set_IHDR(png_, info_, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        if (text_count > 0) png_set_text(png_, info_, texts, text_count);
        png_write_info(png_, info_);
        for (png_uint_32 y = 0; y < height; ++y)
            png_write_row(png_, bytes + std::size_t{3} * width * y);
        png_write_end(png_, nullptr);
        return true;
    }

    /// Up to the pixels.
    bool read_header(std::FILE* stream) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_init_io(png_, stream);
        png_read_info(png_, info_);
        return true;
    }

    std::span<const png_text_struct> texts() const {
        png_textp texts = nullptr;
        const int count = png_get_text(png_, info_, &texts, nullptr);
        return {texts, static_cast<std::size_t>(count)};
    }

private:
    static void on_error(png_structp png, png_const_charp message) {
        auto* const self = static_cast<PngFile*>(png_get_error_ptr(png));
        std::strncpy(self->message_, message, sizeof(self->message_) - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}

    bool writes_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    char message_[128] = {};
};

/// As UTF-8, without compression. `texts` must outlive it.
std::vector<png_text_struct> for_libpng(const PngTexts& texts) {
    std::vector<png_text_struct> all;
    all.reserve(texts.size());
    for (const auto& [keyword, value] : texts) {
        png_text_struct text{};
        text.compression = PNG_ITXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(keyword.c_str()); // the library copies it
        text.text = const_cast<char*>(value.c_str());
        text.itxt_length = value.size();
        all.push_back(text);
    }
    return all;
}

} // namespace

std::string write_png_stream(std::FILE* stream, int width, int height,
                             std::span<const std::uint8_t> bytes, const PngTexts& texts) {
    const std::vector<png_text_struct> all = for_libpng(texts);
    PngFile png(true);
    if (!png.is_ready()) return "not enough memory";
    return png.write(stream, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                     bytes.data(), all.data(), static_cast<int>(all.size()))
               ? ""
               : png.message();
}

std::string png_attribute(const std::string& file, const std::string& keyword) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                                 std::fclose);
    PngFile png(false);
    if (!stream || !png.is_ready() || !png.read_header(stream.get())) return "";
    for (const png_text_struct& text : png.texts())
        if (keyword == text.key) return text.text;
    return "";
}

} // namespace parhelion
