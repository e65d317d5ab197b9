// Checks of an EXR file's header before memory is taken for its pixels.
#pragma once

#include "host/image/exr_source.h"

#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>

#include <cstdint>
#include <utility>

namespace parhelion {

/// The most rows that any compression puts in a chunk: as many are read at a time.
inline constexpr int band_rows = 256;

std::pair<std::int64_t, std::int64_t> box_size(const Imath::Box2i& box);

/// How many times its input a compression may grow at most; 0 where no bound is known.
std::int64_t largest_gain(Imf::Compression compression);

bool is_luminance_chroma(const Imf::Header& header);

/// Refuses a part of deep data, of a size that is empty, too large or more than the file can hold,
/// incomplete, of other windows than the first, or with subsampled channels. Throws InputError.
void check_part(const ExrSource& source, const Imf::MultiPartInputFile& input, int part);

} // namespace parhelion
