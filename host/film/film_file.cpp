// Films in files.
#include "host/film/film_file.h"

#include "host/digest.h"
#include "host/error.h"
#include "host/film/film_header.h"
#include "host/read_at.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace parhelion {
namespace {

/// Words are in the order of the machine, which a file says.
constexpr std::array<std::uint32_t, 4> magic{0x4c485250, 0x4d4c4946, 0x01020304, 1};

struct Begin {
    std::array<std::uint32_t, 4> magic;
    std::uint64_t header_bytes;
    std::uint64_t checksum; ///< of the header, padded with zeros to whole words
};

/// Before the digits of a row of pixels of one channel.
struct RowBegin {
    std::uint32_t y;
    std::uint16_t channel;
    std::uint8_t first, count; ///< digits
    std::uint64_t checksum;    ///< of the digits and their place

    std::uint64_t place() const {
        return std::uint64_t{y} << 32 | std::uint64_t{channel} << 16 | first << 8 | count;
    }
};

constexpr std::uint32_t end_mark =
    0xffffffff; // as y of a last row, whose checksum is how many there are

constexpr std::uint16_t coverage_channel = 0xffff;

/// Names of files need not be UTF-8, which JSON is.
std::string text_of(const FilmHeader& header) {
    return to_json(header).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::uint32_t> words_of(const std::string& text) {
    std::vector<std::uint32_t> words((text.size() + 3) / 4);
    std::memcpy(words.data(), text.data(), text.size());
    return words;
}

template<class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_words(std::ostream& out, std::span<const std::uint32_t> words) {
    out.write(reinterpret_cast<const char*>(words.data()),
              static_cast<std::streamsize>(words.size_bytes()));
}

/// Writes a row, if there is something in it.
bool put_row(std::ostream& out, int y, int channel, SumRow& row) {
    const DigitRange range = digits_in_use(row);
    if (range.count == 0) return false;
    const auto digits = row.digits(range);
    RowBegin begin{static_cast<std::uint32_t>(y), static_cast<std::uint16_t>(channel), range.first,
                   range.count, 0};
    begin.checksum = checksum_of(digits, begin.place());
    put(out, begin);
    put_words(out, digits);
    return true;
}

static_assert(sizeof(ShapeWeight) == 4 * sizeof(std::uint32_t));

/// As a row of another channel, behind which stands how many weights follow.
bool put_coverage(std::ostream& out, int y, const FilmSums& sums) {
    ShapeWeights row;
    sums.add_coverage(y, row);
    add_up(row);
    if (row.empty()) return false;
    std::vector<std::uint32_t> words(4 * row.size());
    std::memcpy(words.data(), row.data(), row.size() * sizeof(ShapeWeight));
    RowBegin begin{static_cast<std::uint32_t>(y), coverage_channel, 0, 0, 0};
    begin.checksum = checksum_of(words, begin.place());
    put(out, begin);
    put(out, std::uint64_t{row.size()});
    put_words(out, words);
    return true;
}

void put_film(std::ostream& out, const FilmHeader& header, const FilmSums& sums) {
    const std::vector<std::uint32_t> text = words_of(text_of(header));
    put(out, Begin{magic, text.size() * 4, checksum_of(text)});
    put_words(out, text);
    std::uint64_t rows = 0;
    SumRow row(header.content.film.crop_width);
    for (int y = 0; y < header.content.film.crop_height; y++)
        for (int channel = 0; channel < header.content.channels(); channel++) {
            row.clear();
            sums.add_row(channel, y, row);
            rows += put_row(out, y, channel, row);
        }
    for (int y = 0; y < header.content.film.crop_height; y++)
        rows += put_coverage(out, y, sums);
    put(out, RowBegin{end_mark, 0, 0, 0, rows});
}

} // namespace

void write_film(const std::string& file, const FilmHeader& header, const FilmSums& sums,
                Existing existing) {
    PendingFile pending(file, existing);
    std::ofstream out(pending.temporary_name(), std::ios::binary);
    put_film(out, header, sums);
    out.close();
    if (!out)
        throw OutputError(fmt::format("{}: cannot be written: {}", file, std::strerror(errno)));
    pending.commit();
}

std::string film_bytes(const FilmHeader& header, const FilmSums& sums) {
    std::ostringstream out;
    put_film(out, header, sums);
    return std::move(out).str();
}

std::uint64_t most_film_bytes(const FilmHeader& header) {
    constexpr std::uint64_t growing = 16384; // samples, counts and faults of the header, as text
    const FilmContent& content = header.content;
    const auto width = static_cast<std::uint64_t>(content.film.crop_width);
    const auto height = static_cast<std::uint64_t>(content.film.crop_height);
    const std::uint64_t rows = height * static_cast<std::uint64_t>(content.channels());
    std::uint64_t bytes = sizeof(Begin) + text_of(header).size() + growing + sizeof(RowBegin) +
                          rows * (sizeof(RowBegin) + 4 * EXACT_WORDS * width);
    if (content.cryptomatte.layers.empty()) return bytes;
    // Each sample meets one shape, or none, and counts for what its filter reaches.
    const auto reach = static_cast<std::uint64_t>(2 * sample_window(content.film).reach + 1);
    const std::uint64_t shapes = std::min<std::uint64_t>(
        content.cryptomatte.layers[0].names.size() + 1,
        reach * reach * static_cast<std::uint64_t>(header.samples_per_pixel));
    return bytes + height * (sizeof(RowBegin) + sizeof(std::uint64_t) +
                             width * shapes * sizeof(ShapeWeight));
}

bool begins_as_film(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false; // what is read there is gone
    std::array<std::uint32_t, 2> begin{};
    std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(begin.data()), sizeof begin);
    return begin[0] == magic[0] && begin[1] == magic[1];
}

struct FilmFile::Row {
    std::uint64_t at = 0; ///< of the digits; 0: there are none
    DigitRange range;
    std::uint64_t checksum = 0;
};

struct FilmFile::CoverageRow {
    std::uint64_t at = 0, count = 0; ///< of weights; 0: there are none
    std::uint64_t checksum = 0;
};

FilmFile::FilmFile(const std::string& file) : name_(file) {
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor_ < 0 || fstat(descriptor_, &status) != 0)
        throw InputError(fmt::format("{}: cannot be opened: {}", file, std::strerror(errno)));
    size_ = static_cast<std::uint64_t>(status.st_size);
    try {
        if (!S_ISREG(status.st_mode)) throw InputError("it is no file");
        read_header();
        find_rows();
    } catch (const std::exception& e) {
        ::close(descriptor_);
        throw InputError(fmt::format("{}: is no whole film of this program: {} (accepted: what "
                                     "--checkpoint and --shard write)",
                                     file, e.what()));
    }
}

FilmFile::~FilmFile() { ::close(descriptor_); }

void FilmFile::read(std::uint64_t at, void* bytes, std::size_t count) const {
    if (at > size_ || count > size_ - at) throw InputError("it ends too early");
    if (!read_at(descriptor_, at, bytes, count)) throw InputError("it cannot be read");
}

void FilmFile::read_header() {
    Begin begin{};
    read(0, &begin, sizeof begin);
    if (begin.magic != magic) throw InputError("it begins otherwise");
    if (begin.header_bytes > size_ || begin.header_bytes % 4 != 0)
        throw InputError("it ends too early");
    std::vector<std::uint32_t> text(begin.header_bytes / 4);
    read(sizeof begin, text.data(), begin.header_bytes);
    if (checksum_of(text) != begin.checksum) throw InputError("its header is damaged");
    std::string json(reinterpret_cast<const char*>(text.data()), begin.header_bytes);
    while (!json.empty() && json.back() == '\0')
        json.pop_back();
    header_ = film_header(nlohmann::json::parse(json));
    rows_begin_ = sizeof begin + begin.header_bytes;
}

void FilmFile::find_rows() {
    const auto width = static_cast<std::uint64_t>(header_.content.film.crop_width);
    const auto height = static_cast<std::uint32_t>(header_.content.film.crop_height);
    const auto channels = static_cast<std::size_t>(header_.content.channels());
    rows_.resize(height * channels);
    coverage_rows_.resize(height);
    std::uint64_t at = rows_begin_, count = 0;
    for (RowBegin row{};; count++) {
        read(at, &row, sizeof row);
        at += sizeof row;
        if (row.y == end_mark) {
            if (row.place() != RowBegin{end_mark, 0, 0, 0, 0}.place() || row.checksum != count ||
                at != size_)
                throw InputError("it ends otherwise");
            return;
        }
        if (row.channel == coverage_channel) {
            find_coverage(row.y, row.checksum, at);
            continue;
        }
        if (row.y >= height || row.channel >= channels || row.first + row.count > EXACT_WORDS)
            throw InputError("a row lies outside of it");
        Row& known = rows_[row.y * channels + row.channel];
        if (known.at != 0) throw InputError("a row is there twice");
        known = {at, {row.first, row.count}, row.checksum};
        at += 4 * width * row.count;
    }
}

/// Behind its beginning, up to that of the next row.
void FilmFile::find_coverage(std::uint32_t y, std::uint64_t checksum, std::uint64_t& at) {
    if (y >= coverage_rows_.size() || header_.content.cryptomatte.layers.empty())
        throw InputError("a row lies outside of it");
    CoverageRow& known = coverage_rows_[y];
    if (known.count != 0) throw InputError("a row is there twice");
    read(at, &known.count, sizeof known.count);
    at += sizeof known.count;
    if (known.count == 0 || known.count > (size_ - at) / sizeof(ShapeWeight))
        throw InputError("it ends too early");
    known.at = at, known.checksum = checksum;
    at += known.count * sizeof(ShapeWeight);
}

void FilmFile::add_coverage(int y, ShapeWeights& row) const {
    const CoverageRow& known = coverage_rows_[static_cast<std::size_t>(y)];
    std::vector<std::uint32_t> words(4 * known.count);
    if (words.empty()) return;
    read(known.at, words.data(), words.size() * sizeof(std::uint32_t));
    const RowBegin begin{static_cast<std::uint32_t>(y), coverage_channel, 0, 0, 0};
    const std::size_t before = row.size();
    row.resize(before + known.count);
    std::memcpy(static_cast<void*>(&row[before]), words.data(),
                words.size() * sizeof(std::uint32_t));
    const auto shapes =
        static_cast<std::int64_t>(header_.content.cryptomatte.layers[0].names.size());
    const bool good = std::all_of(
        row.begin() + static_cast<std::ptrdiff_t>(before), row.end(), [&](const ShapeWeight& w) {
            return w.place >= 0 && w.place < header_.content.film.crop_width &&
                   w.shape >= no_shape && w.shape < shapes;
        });
    if (checksum_of(words, begin.place()) != known.checksum || !good)
        throw InputError(fmt::format("{}: is damaged in row {} of its picture", name_, y));
}

void FilmFile::add_row(int channel, int y, SumRow& row) const {
    const Row& known = rows_[y * header_.content.channels() + channel];
    if (known.at == 0) return;
    SumRow read_row(static_cast<int>(row.width()));
    const auto digits = read_row.digits(known.range);
    read(known.at, digits.data(), digits.size_bytes());
    const RowBegin begin{static_cast<std::uint32_t>(y), static_cast<std::uint16_t>(channel),
                         known.range.first, known.range.count, 0};
    if (checksum_of(digits, begin.place()) != known.checksum)
        throw InputError(fmt::format("{}: is damaged in row {} of its picture", name_, y));
    add_digits(row, 0, row.width(), [&](int k) { return read_row.digit(k).data(); });
}

} // namespace parhelion
