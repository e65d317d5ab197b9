// Text files of data, in whatever encoding and with whatever ends of lines programs write them.
#pragma once

#include "host/error.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// Whether the bytes are UTF-16, with or without a byte order mark. Throws InputError for UTF-32.
bool is_utf16(std::string_view bytes, const SourceLocation& place);

/// UTF-16 with its characters beyond ASCII, which only names and comments have, as '?'.
std::string ascii_of_utf16(std::string_view bytes);

std::string_view without_utf8_mark(std::string_view bytes);

/// The whole of `text` as a number, which may be NaN or infinite ("1.#QNAN" as well); what a double
/// cannot hold is infinite or 0. Nothing for what is no number.
std::optional<double> parse_real(std::string_view text);

/// The lines of a text, which end in LF, CR or CR LF.
class LineReader {
public:
    explicit LineReader(std::string_view text) : text_(text) {}

    bool next();
    /// Adds the next line where the current one ends in a backslash; whether it did.
    bool join_continued();

    std::string_view line() const { return text_.substr(start_, end_ - start_); }
    int number() const { return number_; } ///< from 1

private:
    void find_end(std::size_t from);

    std::string_view text_;
    std::size_t start_ = 0, end_ = 0, next_ = 0;
    std::size_t feed_ = 0; ///< first LF at or after `next_`
    bool feed_known_ = false;
    int number_ = 0, lines_ = 0;
};

/// Splits at blanks, and at ends of lines that a backslash stands before, into `words`, whose
/// memory is used again.
void split_words(std::string_view line, std::vector<std::string_view>& words);

} // namespace parhelion
