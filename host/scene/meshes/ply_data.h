// The numbers of a PLY file, as text or as bytes of either order.
#pragma once

#include "host/scene/meshes/ply_header.h"

#include <limits>
#include <string_view>

namespace parhelion {

/// One number after the other from the data of a PLY file, which may be other than finite. Every
/// PLY type fits a double exactly. Throws InputError where the file ends or holds no number.
class PlyData {
public:
    PlyData(std::string_view file, const PlyHeader& header, const SourceLocation& place);

    double next(PlyType type) {
        return encoding_ == PlyEncoding::ascii ? next_word() : next_binary(type);
    }

    bool has_more() const;
    std::size_t bytes_left() const { return file_.size() - offset_; }
    /// Of entries of `least` bytes, the blank behind the last of which may be missing.
    std::uint64_t most_entries(std::size_t least) const {
        return least > 0 ? bytes_left() / least + 1 : std::numeric_limits<std::uint64_t>::max();
    }
    PlyEncoding encoding() const { return encoding_; }
    const SourceLocation& place() const { return place_; }

private:
    double next_word();
    double next_binary(PlyType type);

    std::string_view file_;
    std::size_t offset_;
    PlyEncoding encoding_;
    SourceLocation place_;
};

} // namespace parhelion
