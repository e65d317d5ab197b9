// Options as a shell would be given them again.
#include "host/commands/command_text.h"

#include "host/commands/option_number.h"
#include "host/commands/option_text.h"
#include "host/safe_text.h"

#include <fmt/format.h>

namespace parhelion {
namespace {

std::string text_of(const std::string& value) { return quoted_for_shell(value); }
template<class Number>
std::string text_of(const Number& value) {
    return fmt::format("{}", value);
}

/// As bash, ksh and zsh read it, whatever bytes are in it: $'\033'.
std::string quoted_with_escapes(const std::string& text) {
    std::string out = "$'";
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte >= 0x7f)
            out += fmt::format("\\{:03o}", byte);
        else
            out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return out + "'";
}

template<class T>
std::string given(const Option&, const T&) {
    return "";
}

template<class T>
std::string given(const Option& option, const std::optional<T>& value) {
    return value ? fmt::format(" {} {}", option_name(option), text_of(*value)) : "";
}

std::string given(const Option& option, const bool& value) {
    bool clears = option.names[0] == '!';
    return value != clears ? " " + option_name(option) : "";
}

std::string given(const Option& option, const std::vector<std::string>& values) {
    std::string text;
    if (option.rules.delimiter == 0)
        for (const std::string& value : values)
            text += fmt::format(" {} {}", option_name(option), quoted_for_shell(value));
    else if (!values.empty())
        text = fmt::format(
            " {} {}", option_name(option),
            quoted_for_shell(fmt::format(
                "{}", fmt::join(values, std::string_view(&option.rules.delimiter, 1)))));
    return text;
}

} // namespace

std::string quoted_for_shell(const std::string& text) {
    constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                  "-_./=,:+@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    if (as_one_line(text) != text) return quoted_with_escapes(text);
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string given_option(const Option& option) {
    if (is_positional(option)) return "";
    return std::visit([&](const auto* target) { return given(option, *target); }, option.target);
}

} // namespace parhelion
