// Opening an EXR file of unknown origin and bounding what its header may make a reader allocate.
#pragma once

#include <ImfIO.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace parhelion {

/// A file that is about to be read, and how errors in it are raised.
struct ExrSource {
    std::string file; ///< its name
    std::int64_t bytes = 0;
    std::unique_ptr<Imf::IStream> stream; ///< of its content

    /// Throws InputError "file: what".
    [[noreturn]] void refuse(const std::string& what) const;
};

/// Refuses what is missing, cannot be opened or is no regular file. Throws InputError.
ExrSource open_exr(const std::string& file);

/// The bytes, which must stay where they are, as if they were a file called `name`.
ExrSource exr_in_memory(std::string_view bytes, const std::string& name);

/// Refuses what is no OpenEXR file, and header attributes that claim more bytes than the file has
/// (the library would allocate them before it finds the file's end) or not those of their type.
/// Leaves the stream at its start. Throws InputError, or the library's exception at the end of the
/// file.
void check_header(const ExrSource& source);

/// What is being thrown, out of the library or for want of memory, as the source's InputError.
[[noreturn]] void refuse_as_input(const ExrSource& source);

/// What `read` returns; throws InputError whatever goes wrong in it.
template<class Read>
auto read_refusing(const ExrSource& source, Read read) {
    try {
        return read();
    } catch (...) {
        refuse_as_input(source);
    }
}

} // namespace parhelion
