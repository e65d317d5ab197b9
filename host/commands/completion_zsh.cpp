// Command lines completed by zsh, through its function _arguments.
#include "host/commands/completion.h"
#include "host/commands/option_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parhelion {
namespace {

/// In a single-quoted word, as a text of _arguments or _describe.
std::string escaped(const std::string& text, std::string_view special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) out += '\\';
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return out;
}

std::string described(const std::string& text) { return escaped(text, "\\[]"); }

/// ":message:action" for the value of an option; nothing for a flag.
std::string value_of(const Option& option) {
    if (is_flag(option)) return "";
    std::string action = " ";
    if (option.rules.kind == ValueKind::file) action = "_files";
    if (option.rules.kind == ValueKind::folder) action = "_files -/";
    const std::string words = fmt::format("{}", fmt::join(option.rules.words, " "));
    if (!words.empty() && option.rules.delimiter == 0) action = "(" + words + ")";
    if (!words.empty() && option.rules.delimiter != 0)
        action = fmt::format("_values -s {} value {}", option.rules.delimiter, words);
    return fmt::format(":{}:{}", escaped(value_name(option), "\\:"), action);
}

/// Options that may be repeated have a star; others leave their other names out once given.
std::string line_of(const Option& option) {
    const std::vector<std::string> names = dashed_names(option);
    const std::string value = value_of(option);
    if (names.empty()) return fmt::format("                '{}'", value);
    const bool repeated = std::holds_alternative<std::vector<std::string>*>(option.target);
    const std::string before = repeated ? "*" : fmt::format("({})", fmt::join(names, " "));
    std::string line;
    for (const std::string& name : names)
        line += fmt::format("{}                '{}{}{}[{}]{}'", line.empty() ? "" : " \\\n", before,
                            name, is_flag(option) || !name.starts_with("--") ? "" : "=",
                            described(help_text(option)), value);
    return line;
}

std::string case_of(const Subcommand& subcommand) {
    std::string text = fmt::format(
        "        {})\n            _arguments -s : \\\n                '(- *)'{{-h,--help}}'[show "
        "help]'",
        subcommand.name);
    for (const Option& option : subcommand.options)
        text += " \\\n" + line_of(option);
    return text + "\n            ;;\n";
}

} // namespace

std::string zsh_completion(const CommandLine& command_line) {
    std::string names, cases;
    for (const Subcommand& subcommand : command_line.subcommands) {
        names +=
            fmt::format("        '{}:{}'\n", subcommand.name, escaped(subcommand.summary, "\\:"));
        cases += case_of(subcommand);
    }
    return "#compdef parhelion\n"
           "# Completes command lines of parhelion in zsh; made by `parhelion completion zsh`.\n"
           "\n"
           "_parhelion() {\n"
           "    local curcontext=$curcontext state line\n"
           "    local -a subcommands\n"
           "    subcommands=(\n" +
           names +
           "    )\n"
           "    _arguments -C '(- *)'{-h,--help}'[show help]' '(- *)--version[show the version]' "
           "\\\n"
           "        '1:subcommand:->subcommand' '*::argument:->argument'\n"
           "    if [[ $state == subcommand ]]; then\n"
           "        _describe subcommand subcommands\n"
           "        return\n"
           "    fi\n"
           "    [[ $state == argument ]] || return\n"
           "    case $line[1] in\n" +
           cases +
           "    esac\n"
           "}\n"
           "\n"
           "_parhelion \"$@\"\n";
}

} // namespace parhelion
