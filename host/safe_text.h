// Text of unknown origin, fit for a terminal and for one line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// `text` with everything that a terminal would obey instead of showing it written as an escape:
/// control characters (those below space but line ends and tabs, DEL, U+0080 to U+009F), line
/// separators and marks of writing direction as \u001b, bytes that are no UTF-8 as \xff. The former
/// mean the same inside a string of JSON.
std::string safe_text(std::string_view text);

/// The same, and line ends and tabs are escapes as well: names and values that a message repeats
/// cannot break its line.
std::string as_one_line(std::string_view text);

/// Each of `texts` as one line, and line ends between them.
std::string as_lines(const std::vector<std::string>& texts);

} // namespace parhelion
