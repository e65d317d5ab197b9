// What is told of exit codes, from their list (host/error.h).
#include "host/commands/exit_codes.h"

#include "host/error.h"

#include <fmt/format.h>

namespace parhelion {

std::string exit_codes_text() {
    std::string text = "Exit codes:\n";
    for (const auto& [code, meaning] : exit_code_meanings)
        text += fmt::format("  {:>2}  {}\n", static_cast<int>(code), meaning);
    return text + "Each subcommand has its own --help with examples.";
}

std::string exit_codes_table() {
    std::string text;
    for (const auto& [code, meaning] : exit_code_meanings)
        text += fmt::format("| {} | {} |\n", static_cast<int>(code), meaning);
    return text;
}

} // namespace parhelion
