// The numbers of a PLY file, as text or as bytes of either order.
#include "host/scene/meshes/ply_data.h"

#include "host/scene/meshes/data_text.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

namespace parhelion {

namespace {

constexpr std::string_view blanks = " \t\r\n";

template<typename T>
double as_double(const std::array<char, 8>& bytes) {
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
}

} // namespace

PlyData::PlyData(std::string_view file, const PlyHeader& header, const SourceLocation& place)
    : file_(file), offset_(header.data_start), encoding_(header.encoding), place_(place) {
    place_.line = encoding_ == PlyEncoding::ascii ? header.lines + 1 : 0;
}

bool PlyData::has_more() const {
    if (encoding_ != PlyEncoding::ascii) return bytes_left() > 0;
    return file_.find_first_not_of(blanks, offset_) != std::string_view::npos;
}

double PlyData::next_word() {
    const std::size_t start = std::min(file_.find_first_not_of(blanks, offset_), file_.size());
    place_.line +=
        static_cast<int>(std::count(file_.begin() + static_cast<std::ptrdiff_t>(offset_),
                                    file_.begin() + static_cast<std::ptrdiff_t>(start), '\n'));
    offset_ = std::min(file_.find_first_of(blanks, start), file_.size());
    if (start == offset_) refuse(place_, "the PLY file ends too early");
    const std::string_view word = file_.substr(start, offset_ - start);
    const std::optional<double> value = parse_real(word);
    if (!value) refuse(place_, in_quotes(word) + " is not a number");
    return *value;
}

double PlyData::next_binary(PlyType type) {
    const std::size_t size = ply_type_size(type);
    if (bytes_left() < size) refuse(place_, "the PLY file ends too early");
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), file_.data() + offset_, size);
    offset_ += size;
    const bool little = encoding_ == PlyEncoding::little_endian;
    if (little != (std::endian::native == std::endian::little))
        std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    switch (type) {
    case PlyType::int8:
        return as_double<std::int8_t>(bytes);
    case PlyType::uint8:
        return as_double<std::uint8_t>(bytes);
    case PlyType::int16:
        return as_double<std::int16_t>(bytes);
    case PlyType::uint16:
        return as_double<std::uint16_t>(bytes);
    case PlyType::int32:
        return as_double<std::int32_t>(bytes);
    case PlyType::uint32:
        return as_double<std::uint32_t>(bytes);
    case PlyType::float32:
        return as_double<float>(bytes);
    case PlyType::float64:
        return as_double<double>(bytes);
    }
    refuse(place_, "unknown PLY type");
}

} // namespace parhelion
