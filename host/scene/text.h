// Reading numbers out of text the same way in every locale, and quoting foreign text in one-line
// messages.
#pragma once

#include "host/error.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// The whole of `text` (blanks around it allowed) as a finite number; nothing for NaN, infinity,
/// trailing characters, or a magnitude a double cannot hold.
std::optional<double> parse_number(std::string_view text);

/// The whole of `text` (blanks around it allowed) as a decimal integer of 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Splits at any run of the separators; no empty pieces.
std::vector<std::string_view> split(std::string_view text, std::string_view separators);

/// `text` in double quotes, control characters replaced and shortened, so that a message stays one
/// line.
std::string in_quotes(std::string_view text);

std::string lower_case(std::string_view text);

/// Throws InputError "<place>: <message>".
[[noreturn]] void refuse(const SourceLocation& place, const std::string& message);

/// f(), which reads a file that is named at `place`: what is wrong in a file does not say who names
/// it. Throws f's InputErrors with the place before them, but those that begin with it.
template<class F>
auto named_at(const SourceLocation& place, const F& f) -> decltype(f()) {
    try {
        return f();
    } catch (const InputError& error) {
        const std::string what = error.what();
        if (what.starts_with(place.to_string())) throw;
        refuse(place, what);
    }
}

} // namespace parhelion
