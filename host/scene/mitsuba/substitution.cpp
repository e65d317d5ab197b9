// Named parameters of a scene: <default>, -D name=value and $name in attributes.
#include "host/scene/mitsuba/substitution.h"

#include "host/scene/text.h"

namespace parhelion::mitsuba {

namespace {

/// Defaults made of defaults double in length with every line.
constexpr std::size_t max_length = std::size_t(1) << 20;

} // namespace

std::string_view Substitution::longest_name(std::string_view text) const {
    std::string_view best;
    for (const auto& [name, value] : values_)
        if (text.starts_with(name) && name.size() > best.size()) best = text.substr(0, name.size());
    return best;
}

std::string Substitution::apply(std::string_view text, const SourceLocation& place) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '$') {
            result += text[++i];
        } else if (text[i] != '$') {
            result += text[i];
        } else {
            const std::string name(longest_name(text.substr(i + 1)));
            if (name.empty()) {
                const std::string_view rest = text.substr(i + 1);
                const std::size_t end = rest.find_first_not_of(
                    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
                refuse(place,
                       "parameter " + in_quotes(text.substr(i, end == rest.npos ? end : end + 1)) +
                           " has no value (give a <default> or -D name=value; \\$ writes a $)");
            }
            result += values_.at(name);
            used_.insert(name);
            if (result.size() > max_length)
                refuse(place, "an attribute grows beyond " + std::to_string(max_length) +
                                  " characters by its parameters");
            i += name.size();
        }
    }
    return result;
}

} // namespace parhelion::mitsuba
