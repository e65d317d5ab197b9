// JPEG files as texels, through libjpeg-turbo.
#include "host/image/texel_formats.h"

#include <csetjmp>
#include <cstdio> // before jpeglib.h, which needs it

#include <jerror.h>
#include <jpeglib.h>

namespace parhelion {

namespace {

/// More are no photograph: a small file can make the decoder go over a large image again and again.
constexpr int most_scans = 200;

/// A file that the library reads. It jumps to where it is asked from when it finds something wrong:
/// functions that call it have nothing to destroy.
class JpegReader {
public:
    explicit JpegReader(const ImageBytes& file) : file_(file) {
        jpeg_.err = jpeg_std_error(&errors_);
        errors_.error_exit = on_error;
        errors_.emit_message = on_message;
        jpeg_.client_data = this;
        if (setjmp(jump_) != 0) refuse();
        jpeg_create_decompress(&jpeg_);
        progress_.progress_monitor = on_progress;
        jpeg_.progress = &progress_;
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    void read_header() {
        if (setjmp(jump_) != 0) refuse();
        jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(file_.bytes.data()),
                     file_.bytes.size());
        jpeg_read_header(&jpeg_, TRUE);
    }
    void read_rows(std::byte* to, std::size_t row_bytes) {
        if (setjmp(jump_) != 0) refuse();
        jpeg_.out_color_space = jpeg_.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
        jpeg_start_decompress(&jpeg_);
        while (jpeg_.output_scanline < jpeg_.output_height) {
            JSAMPROW row = reinterpret_cast<JSAMPROW>(to) + jpeg_.output_scanline * row_bytes;
            jpeg_read_scanlines(&jpeg_, &row, 1);
        }
        jpeg_finish_decompress(&jpeg_);
    }
    const jpeg_decompress_struct& header() const { return jpeg_; }

private:
    [[noreturn]] void refuse() {
        char message[JMSG_LENGTH_MAX] = {};
        errors_.format_message(reinterpret_cast<j_common_ptr>(&jpeg_), message);
        file_.refuse("cannot be read as JPEG: " + std::string(message));
    }
    static void on_error(j_common_ptr jpeg) {
        std::longjmp(static_cast<JpegReader*>(jpeg->client_data)->jump_, 1);
    }
    /// What is a warning to the library is missing or broken pixels, but for a few.
    static void on_message(j_common_ptr jpeg, int level) {
        const int code = jpeg->err->msg_code;
        const bool harmless =
            code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_JFIF_MAJOR;
        if (level < 0 && !harmless) on_error(jpeg);
    }
    static void on_progress(j_common_ptr jpeg) {
        if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= most_scans) return;
        jpeg->err->msg_code = JERR_BAD_PROGRESSION;
        on_error(jpeg);
    }

    const ImageBytes& file_;
    jpeg_decompress_struct jpeg_{};
    jpeg_error_mgr errors_{};
    jpeg_progress_mgr progress_{};
    std::jmp_buf jump_{};
};

} // namespace

bool is_jpeg(const ImageBytes& file) { return file.bytes.starts_with("\xff\xd8\xff"); }

TexelLayout layout_of_jpeg(const ImageBytes& file) {
    JpegReader jpeg(file);
    jpeg.read_header();
    const jpeg_decompress_struct& header = jpeg.header();
    if (header.num_components != 1 && header.num_components != 3)
        file.refuse("a JPEG of " + std::to_string(header.num_components) +
                    " components (accepted: 1, grey; 3, colours)");
    TexelLayout layout;
    set_size(file, header.image_width, header.image_height, layout);
    layout.channels = header.num_components;
    layout.srgb = true;
    return layout;
}

void read_jpeg(const ImageBytes& file, const TexelLayout& layout, std::span<std::byte> to) {
    JpegReader jpeg(file);
    jpeg.read_header();
    jpeg.read_rows(to.data(), layout.width * layout.texel_bytes());
}

} // namespace parhelion
