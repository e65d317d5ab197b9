// OpenEXR files: reading what a comparison or texture needs, writing what the renderer makes.
#pragma once

#include "host/image/component_format.h"
#include "host/image/exr_compression.h"
#include "host/image/image_rows.h"
#include "host/image/misfits.h"
#include "host/image/output.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// Reads an OpenEXR file: scanline or tiled (the full-resolution level), half, float or uint
/// components, any compression, one part or several. Values come as stored; chromaticities are not
/// applied. Luminance-chroma files come as R, G, B. The channels of a file of several parts are
/// named part.channel. Metadata: the string, int, float and double attributes that are not part of
/// the format itself.
/// Throws InputError for a file that is damaged, incomplete or absurdly large, and for deep data,
/// subsampled channels, parts of different windows, and uint values of 2^24 and more (a float
/// cannot hold each of them).
Image read_exr(const std::string& file);

/// The same of a file's bytes at hand, called `name` in messages.
Image parse_exr(std::string_view bytes, const std::string& name);

/// A text attribute of a file's header; nothing where there is none, or no such file.
std::string exr_attribute(const std::string& file, const std::string& name);

struct ExrOptions {
    ComponentFormat component = ComponentFormat::float32;
    Existing existing = Existing::replace; ///< what check_output has asked for
    ExrCompression compression = ExrCompression::zip;
    /// Of layers (layer_of) that have another than `component`.
    std::map<std::string, ComponentFormat> layers{};

    ComponentFormat component_of(const std::string& channel) const;
};

/// Whether a file's compression and the components of its channels are those; false where there is
/// no such file.
bool is_written_as(const std::string& file, const ExrOptions& options);

/// Writes scanlines as linear values with Rec. 709 primaries stated. The file
/// appears whole or not at all, as PendingFile says. Returns, for each channel that has some, how
/// many values are not finite or do not fit the component format. float32 and float16 keep what is
/// not finite; float16 stores values beyond 65504 (65519 rounds to it) as infinity, uint32 the
/// nearest integer, of what is outside its range the nearest end, of NaN 0. Values that are merely
/// rounded, or too small for the format, are not counted. An int64 beyond 32 bits is stored as its
/// decimal digits, since EXR has no wider integer. Throws OutputError where the folder or the disk
/// refuses. What the rows throw is thrown on, and no file is there.
[[nodiscard]] std::vector<Misfits> write_exr(const std::string& file, const ImageRows& image,
                                             const ExrOptions& options = {});
[[nodiscard]] inline std::vector<Misfits> write_exr(const std::string& file, const Image& image,
                                                    const ExrOptions& options = {}) {
    return write_exr(file, WholeImage(image), options);
}

} // namespace parhelion
