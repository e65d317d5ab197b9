// Checks of an EXR file before the library reads it.
#include "host/image/exr_source.h"

#include "host/error.h"

#include <Iex.h>
#include <ImfStdIO.h>
#include <ImfVersion.h>
#include <ImfXdr.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <utility>

namespace parhelion {

namespace {

class MemoryStream : public Imf::IStream {
public:
    MemoryStream(std::string_view bytes, const std::string& name)
        : Imf::IStream(name.c_str()), bytes_(bytes) {}

    bool read(char* target, int count) override {
        const auto wanted = static_cast<std::size_t>(count);
        if (count < 0 || at_ > bytes_.size() || wanted > bytes_.size() - at_)
            throw Iex::InputExc("Unexpected end of file.");
        std::copy_n(bytes_.data() + at_, wanted, target);
        at_ += wanted;
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    std::string_view bytes_;
    std::uint64_t at_ = 0;
};

using Name = std::array<char, 256>; ///< the longest name the format has, with its end

template<class T>
T read_number(Imf::IStream& stream) {
    T value{};
    Imf::Xdr::read<Imf::StreamIO>(stream, value);
    return value;
}

Name read_name(Imf::IStream& stream) {
    Name name{};
    // It stores one character more than it is told, the end of the name or not.
    Imf::Xdr::read<Imf::StreamIO>(stream, static_cast<int>(name.size()) - 1, name.data());
    if (name.back() != '\0') throw Iex::InputExc("a name in the header has no end.");
    return name;
}

/// The bytes of values whose size the library takes from their type, whatever the file says.
constexpr std::array<std::pair<std::string_view, std::int64_t>, 24> fixed_sizes{
    {{"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
     {"compression", 1}, {"double", 8},   {"envmap", 1},
     {"float", 4},       {"int", 4},      {"keycode", 28},
     {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
     {"m44d", 128},      {"m44f", 64},    {"rational", 8},
     {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
     {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
     {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1}}};

/// Steps over a list of channels as the library does: up to an empty name.
void skip_channels(Imf::IStream& stream) {
    constexpr std::uint64_t after_name = 16; // type, linearity, sampling
    while (read_name(stream)[0] != '\0')
        stream.seekg(stream.tellg() + after_name);
}

/// Steps over a value that claims `size` bytes. Where the library would read more or less, the two
/// would no longer mean the same by what follows.
void skip_value(const ExrSource& source, Imf::IStream& stream, std::string_view type,
                std::int64_t size) {
    const auto end = stream.tellg() + static_cast<std::uint64_t>(size);
    bool good = true;
    for (const auto& [name, bytes] : fixed_sizes)
        good = good && (name != type || bytes == size);
    if (type == "chlist") {
        skip_channels(stream);
        good = stream.tellg() == end;
    }
    if (!good)
        source.refuse("a header attribute of type " + std::string(type) + " claims " +
                      std::to_string(size) + " bytes, not what it has");
    stream.seekg(end);
}

/// Steps over one header (name, type, size and value of each attribute up to an empty name);
/// returns how many attributes it has.
int skip_header(const ExrSource& source, Imf::IStream& stream) {
    int attributes = 0;
    while (read_name(stream)[0] != '\0') {
        const Name type = read_name(stream);
        const std::int64_t size = read_number<int>(stream);
        const std::int64_t left = source.bytes - static_cast<std::int64_t>(stream.tellg());
        if (size < 0 || size > left)
            source.refuse("a header attribute claims " + std::to_string(size) + " bytes where " +
                          std::to_string(left) + " are left");
        skip_value(source, stream, type.data(), size);
        ++attributes;
    }
    return attributes;
}

} // namespace

void ExrSource::refuse(const std::string& what) const { throw InputError(file + ": " + what); }

ExrSource open_exr(const std::string& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) throw InputError(file + ": no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError(file + ": not a regular file");
    const auto bytes = std::filesystem::file_size(file, error);
    if (error) throw InputError(file + ": cannot open: " + error.message());
    if (!std::ifstream(file, std::ios::binary))
        throw InputError(file + ": cannot open: " + std::strerror(errno));
    return {file, static_cast<std::int64_t>(bytes),
            std::make_unique<Imf::StdIFStream>(file.c_str())};
}

ExrSource exr_in_memory(std::string_view bytes, const std::string& name) {
    return {name, static_cast<std::int64_t>(bytes.size()),
            std::make_unique<MemoryStream>(bytes, name)};
}

void check_header(const ExrSource& source) {
    Imf::IStream& stream = *source.stream;
    std::array<char, 4> magic{};
    const bool complete = source.bytes >= static_cast<std::int64_t>(magic.size());
    if (complete) stream.read(magic.data(), magic.size());
    if (!complete || !Imf::isImfMagic(magic.data())) source.refuse("not an OpenEXR file");
    const int version = read_number<int>(stream);
    // A file of several parts ends its headers with one that has no attributes.
    while (skip_header(source, stream) > 0 && Imf::isMultiPart(version)) {
    }
    stream.seekg(0);
}

void refuse_as_input(const ExrSource& source) {
    try {
        throw;
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        source.refuse("not enough memory to read it");
    } catch (const std::exception& error) {
        std::string reason = error.what();
        const std::string opening =
            "\"" + source.file + "\". "; // the library names the file as well
        if (const std::size_t at = reason.find(opening); at != std::string::npos)
            reason.erase(0, at + opening.size());
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        source.refuse("cannot be read as OpenEXR: " + reason);
    }
}

} // namespace parhelion
