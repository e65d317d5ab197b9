// `parhelion man`, `parhelion-stress man`: the manual page, made from the option tables.
#include "host/commands/manual.h"

#include "host/commands/option_text.h"
#include "host/error.h"
#include "host/streams.h"
#include "parhelion_version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace parhelion {
namespace {

/// As roff prints it: no text is a command, a hyphen is one that can be searched for and copied.
std::string roff(const std::string& text) {
    std::string out;
    bool at_start = true;
    for (const char c : text) {
        if (at_start && (c == '.' || c == '\'')) out += "\\&";
        at_start = c == '\n';
        switch (c) {
        case '\\':
            out += "\\(rs";
            break;
        case '-':
            out += "\\-";
            break;
        case '\'':
            out += "\\(aq";
            break;
        case '`':
            out += "\\(ga";
            break;
        case '^':
            out += "\\(ha";
            break;
        case '~':
            out += "\\(ti";
            break;
        default:
            out += c;
        }
    }
    return out;
}

/// "-o, --output FILE", names in bold.
std::string head_of(const Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : dashed_names(option))
        names.push_back("\\fB" + roff(name) + "\\fR");
    const std::string value = value_name(option);
    std::string head = fmt::format("{}", fmt::join(names, ", "));
    if (!value.empty()) head += fmt::format("{}\\fI{}\\fR", head.empty() ? "" : " ", roff(value));
    return head;
}

std::string text_of(const Option& option) {
    std::string text = fmt::format(".TP\n{}\n{}.", head_of(option), roff(help_text(option)));
    if (option.rules.required) text += " Required.";
    if (!option.rules.needs.empty())
        text += roff(fmt::format(" Needs {}.", fmt::join(option.rules.needs, ", ")));
    return text + "\n";
}

/// "parhelion render scene [OPTIONS]".
std::string synopsis(const std::string& program, const Subcommand& subcommand) {
    std::string text = fmt::format("\\fB{} {}\\fR", roff(program), roff(subcommand.name));
    for (const Option& option : subcommand.options)
        if (is_positional(option))
            text +=
                fmt::format(fmt::runtime(option.rules.required ? " \\fI{}\\fR" : " [\\fI{}\\fR]"),
                            roff(option.names));
    return text + " [\\fIOPTIONS\\fR]";
}

/// As they are; what stands behind them, in paragraphs.
std::string examples_of(const Subcommand& subcommand) {
    std::string text, rest = subcommand.examples;
    for (bool first = true; !rest.empty(); first = false) {
        const std::size_t end = std::min(rest.find("\n\n"), rest.size());
        const std::string part = roff(rest.substr(0, end));
        text += first ? fmt::format(".PP\n.EX\n{}\n.EE\n", part) : fmt::format(".PP\n{}\n", part);
        rest.erase(0, std::min(end + 2, rest.size()));
    }
    return text;
}

std::string section_of(const std::string& program, const Subcommand& subcommand) {
    std::string text = fmt::format(".SS {}\n{}.\n.PP\n{}\n", roff(subcommand.name),
                                   roff(subcommand.summary), synopsis(program, subcommand));
    for (const Option& option : subcommand.options)
        text += text_of(option);
    return text + examples_of(subcommand);
}

std::string exit_codes_section() {
    std::string text = ".SH EXIT STATUS\n";
    for (const auto& [code, meaning] : exit_code_meanings)
        text +=
            fmt::format(".TP\n.B {}\n{}.\n", static_cast<int>(code), roff(std::string(meaning)));
    return text;
}

} // namespace

std::string manual_page(const CommandLine& command_line) {
    const std::string& program = command_line.program;
    std::string title = program;
    std::transform(title.begin(), title.end(), title.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::size_t colon = command_line.summary.find(": ");
    std::string page =
        fmt::format(".\\\" Made by `{} man`.\n"
                    ".TH {} 1 \"\" \"Parhelion {}\" \"User Commands\"\n"
                    ".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                    program, roff(title), version_number, roff(program),
                    roff(command_line.summary.substr(colon == std::string::npos ? 0 : colon + 2)));
    for (const Subcommand& subcommand : command_line.subcommands)
        page += synopsis(program, subcommand) + "\n.br\n";
    page += fmt::format("\\fB{}\\fR \\fB\\-\\-help\\fR | \\fB\\-\\-version\\fR\n.SH SUBCOMMANDS\n",
                        roff(program));
    for (const Subcommand& subcommand : command_line.subcommands)
        page += section_of(program, subcommand);
    return page + exit_codes_section();
}

Subcommand manual_subcommand(const std::function<CommandLine()>& command_line,
                             const std::string& program) {
    return {
        .name = "man",
        .summary = "Print the manual page of this program",
        .examples = fmt::format("Example:\n  {} man | man -l -", program),
        .run =
            [command_line] {
                print(manual_page(command_line()));
                return static_cast<int>(ExitCode::ok);
            },
    };
}

} // namespace parhelion
