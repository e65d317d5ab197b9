// A file that is told what standard error is told, besides.
//
// The process has one, as it has one standard error: it is kept by name in spdlog's registry.
#pragma once

#include <string>
#include <string_view>

namespace parhelion {

/// From now on messages go to `file` as well: appended, a line each with the time (UTC) before it,
/// written through at once. Throws InputError for one that cannot be appended to, or is no log.
void open_message_log(const std::string& file);

/// From now on there is none.
void close_message_log() noexcept;

/// Its name; empty: there is none.
std::string message_log_file();

/// Each of the lines of `text`, where there is a log. What cannot be written is lost.
void log_message(std::string_view text) noexcept;

} // namespace parhelion
