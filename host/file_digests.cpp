// Digests of files that are asked for again and again.
#include "host/file_digests.h"

#include "host/digest.h"

namespace parhelion {

const std::string& FileDigests::of(const std::string& file) {
    const std::optional<FileStamp> stamp = file_stamp(file); // before it is read
    const auto known = known_.find(file);
    if (stamp && known != known_.end() && known->second.stamp == stamp) return known->second.digest;
    return known_.insert_or_assign(file, Known{stamp, digest_of_file(file)}).first->second.digest;
}

} // namespace parhelion
