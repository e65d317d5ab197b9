// Opening an EXR file of unknown origin and bounding what its header may make a reader allocate.
#pragma once

#include <cstdint>
#include <string>

namespace parhelion {

/// A file that is about to be read, and how errors in it are raised.
struct ExrSource {
    std::string file;
    std::int64_t bytes = 0;

    /// Throws InputError "file: what".
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Refuses what is missing, no regular file or no OpenEXR file. Throws InputError.
ExrSource open_exr(const std::string& file);

/// Refuses header attributes that claim more bytes than the file has: the library would allocate
/// them before it finds the file's end. Throws InputError, or the library's exception at the end of
/// the file.
void check_attribute_sizes(const ExrSource& source);

} // namespace parhelion
