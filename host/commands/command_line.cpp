// The command line, through CLI11.
#include "host/commands/command_line.h"

#include "host/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <utility>

namespace parhelion {
namespace {

template<class T>
CLI::Option* add_value(CLI::App& app, const Option& option, T& target) {
    CLI::Option* added = app.add_option(option.names, target, option.help);
    if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        // Without this a list would swallow the arguments behind it.
        added->allow_extra_args(false);
        if (option.rules.delimiter != 0) added->delimiter(option.rules.delimiter);
    } else if constexpr (std::is_arithmetic_v<T>) {
        added->capture_default_str();
    } else if constexpr (std::is_same_v<T, std::string>) {
        if (!target.empty()) added->capture_default_str();
    }
    return added;
}

/// A flag that is given a value is refused: the library reads some numbers and the start of others.
CLI::Option* add_value(CLI::App& app, const Option& option, bool& target) {
    const bool clears = option.names[0] == '!'; // the library's own way shows "{false}" in the help
    const std::string names = option.names.substr(clears ? 1 : 0);
    return app
        .add_flag_callback(
            names, [&target, clears] { target = !clears; }, option.help)
        ->disable_flag_override();
}

CLI::Option* add_option(CLI::App& app, const Option& option) {
    CLI::Option* added =
        std::visit([&](auto* target) { return add_value(app, option, *target); }, option.target);
    added->required(option.rules.required);
    if (!option.rules.group.empty()) added->group(option.rules.group);
    return added;
}

void add_subcommand(CLI::App& app, const Subcommand& subcommand, int& exit_code) {
    CLI::App* sub = app.add_subcommand(subcommand.name, subcommand.summary);
    std::vector<CLI::Option*> added;
    for (const Option& option : subcommand.options)
        added.push_back(add_option(*sub, option));
    for (std::size_t i = 0; i < added.size(); i++)
        for (const std::string& other : subcommand.options[i].rules.needs)
            added[i]->needs(sub->get_option(other));
    sub->footer(subcommand.examples);
    sub->callback([&subcommand, &exit_code] { exit_code = subcommand.run(); });
}

} // namespace

struct CommandLineReader::App : CLI::App {
    using CLI::App::App;
};

CommandLineReader::CommandLineReader(const CommandLine& command_line)
    : app_(std::make_unique<App>(command_line.summary, "parhelion")) {
    app_->require_subcommand(1);
    app_->set_version_flag("--version", command_line.version);
    app_->footer(command_line.footer);
    for (const Subcommand& subcommand : command_line.subcommands)
        add_subcommand(*app_, subcommand, exit_code_);
}

CommandLineReader::~CommandLineReader() = default;

int CommandLineReader::run(std::vector<std::string> arguments) {
    exit_code_ = 0;
    std::reverse(arguments.begin(), arguments.end()); // as CLI::App::parse wants them
    try {
        app_->parse(arguments);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app_->exit(e); // help or version
        throw InputError(e.what());
    }
    return exit_code_;
}

int run_command_line(const CommandLine& command_line, std::vector<std::string> arguments) {
    return CommandLineReader(command_line).run(std::move(arguments));
}

} // namespace parhelion
