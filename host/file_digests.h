// Digests of files that are asked for again and again.
#pragma once

#include "host/file_stamp.h"

#include <map>
#include <string>

namespace parhelion {

class FileDigests {
public:
    /// digest_of_file; the file is read once as long as it does not change. Throws as that does.
    const std::string& of(const std::string& file);

private:
    struct Known {
        std::optional<FileStamp> stamp;
        std::string digest;
    };
    std::map<std::string, Known> known_;
};

} // namespace parhelion
