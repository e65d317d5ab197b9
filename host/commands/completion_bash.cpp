// Command lines completed by bash.
#include "host/commands/completion.h"
#include "host/commands/option_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parhelion {
namespace {

// Words are kept with '=' as words of their own; values of a list follow a comma. Files are left to
// compgen, which knows what is quoted.
constexpr const char* functions =
    R"(# Completes command lines of parhelion in bash; made by `parhelion completion bash`.

# Words, of which the last of a list is completed.
_parhelion_words() {
    local before=""
    [[ $2 != *,* ]] || before=${2%,*},
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${2##*,}")
}

_parhelion_files() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen "$1" -- "$2")
}

_parhelion_value() {
    case $1 in
        files) _parhelion_files -f "$2" ;;
        folders) _parhelion_files -d "$2" ;;
        nothing) ;;
        *) _parhelion_words "$1" "$2" ;;
    esac
}

_parhelion() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} subcommand="" i
    COMPREPLY=()
    if [[ $current == = ]]; then
        current=""
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    for ((i = 1; i < COMP_CWORD; i++)); do
        [[ ${COMP_WORDS[i]} == -* ]] || { subcommand=${COMP_WORDS[i]}; break; }
    done
    local options="--help --version" positional="@SUBCOMMANDS@" value=""
    case $subcommand in
@CASES@
    esac
    if [[ -n $value ]]; then
        _parhelion_value "$value" "$current"
    elif [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    else
        _parhelion_value "$positional" "$current"
    fi
}
complete -F _parhelion parhelion
)";

/// What _parhelion_value is to do.
std::string value_of(const Option& option) {
    if (option.rules.kind == ValueKind::file) return "files";
    if (option.rules.kind == ValueKind::folder) return "folders";
    if (option.rules.words.empty()) return "nothing";
    return fmt::format("{}", fmt::join(option.rules.words, " "));
}

std::string case_of(const Subcommand& subcommand) {
    std::string names = "--help", values, positional = "nothing";
    for (const Option& option : subcommand.options) {
        const std::vector<std::string> dashed = dashed_names(option);
        if (dashed.empty()) positional = value_of(option);
        for (const std::string& name : dashed)
            names += " " + name;
        if (!dashed.empty() && !is_flag(option))
            values += fmt::format("                {}) value=\"{}\" ;;\n", fmt::join(dashed, " | "),
                                  value_of(option));
    }
    std::string text = fmt::format("        {})\n            options=\"{}\" positional=\"{}\"\n",
                                   subcommand.name, names, positional);
    if (!values.empty())
        text += fmt::format("            case $before in\n{}            esac\n", values);
    return text + "            ;;";
}

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
    return text.replace(text.find(mark), mark.size(), by);
}

} // namespace

std::string bash_completion(const CommandLine& command_line) {
    std::vector<std::string> names, cases;
    for (const Subcommand& subcommand : command_line.subcommands) {
        names.push_back(subcommand.name);
        cases.push_back(case_of(subcommand));
    }
    const std::string text =
        replaced(functions, "@SUBCOMMANDS@", fmt::format("{}", fmt::join(names, " ")));
    return replaced(text, "@CASES@", fmt::format("{}", fmt::join(cases, "\n")));
}

} // namespace parhelion
