// The last line of a process that ends in a signal handler.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace parhelion {

/// Where and how the last line is told: asked for before, since a handler cannot.
struct LastPlaces {
    int standard_error = -1;
    bool as_json = false;
    std::string log_file{}; ///< empty: none
};

/// One line in memory of its own: a handler can have no other. What is too long is cut off.
class EndLine {
public:
    /// Everything but text of one line becomes a blank.
    void add(std::string_view text);
    /// On standard error and in the log. Safe in a signal handler.
    void tell(const LastPlaces& places);

private:
    void tell_as_json(int file);
    void tell_log(const char* name) const;

    std::array<char, 2048> text_{};
    std::size_t size_ = 0;
};

/// Writes it all, or what can be written. Safe in a signal handler.
void put(int file, std::string_view text);

} // namespace parhelion
