// What `parhelion compare` draws: where two images differ.
#pragma once

#include "host/commands/compare.h"

namespace parhelion {

/// A picture is asked for by the name of its file.
std::vector<Option> picture_options(CompareOptions& options);

/// Refuses, before anything is read, what could not be written. Throws InputError.
void check_pictures(const CompareOptions& options);

/// Writes those asked for. Throws InputError where the images have nothing to draw them from,
/// OutputError where the folder or the disk refuses.
void write_pictures(const CompareOptions& options, const Image& image, const Image& reference,
                    const Comparison& comparison);

} // namespace parhelion
