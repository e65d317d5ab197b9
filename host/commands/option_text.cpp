// What a row of an option table is called, for help, manual and completions.
#include "host/commands/option_text.h"

#include "host/scene/text.h"

#include <fmt/format.h>

namespace parhelion {

std::vector<std::string> dashed_names(const Option& option) {
    std::vector<std::string> names;
    for (const std::string_view name : split(option.names, "!,"))
        if (name.starts_with("-")) names.emplace_back(name);
    return names;
}

bool is_positional(const Option& option) { return dashed_names(option).empty(); }

bool is_flag(const Option& option) { return std::holds_alternative<bool*>(option.target); }

std::string value_name(const Option& option) {
    if (is_flag(option)) return "";
    if (is_positional(option)) return option.names;
    if (option.rules.kind == ValueKind::file) return "FILE";
    if (option.rules.kind == ValueKind::folder) return "FOLDER";
    if (!option.rules.words.empty()) return "WORD";
    return takes_number(option) ? "NUMBER" : "TEXT";
}

std::string help_text(const Option& option) {
    const std::optional<Domain>& domain = option.rules.domain;
    return domain ? fmt::format("{} ({})", option.help, accepted_text(*domain)) : option.help;
}

} // namespace parhelion
