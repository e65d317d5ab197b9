// The command line, through CLI11.
#include "host/commands/command_line.h"

#include "host/commands/nearest_name.h"
#include "host/commands/option_number.h"
#include "host/commands/option_text.h"
#include "host/error.h"
#include "host/scene/text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <type_traits>
#include <utility>

namespace parhelion {
namespace {

template<class T>
struct NumberOf {
    using Type = T;
};
template<class T>
struct NumberOf<std::optional<T>> {
    using Type = T;
};
template<class T>
using Number = typename NumberOf<T>::Type;

/// The library would read some texts that are no numbers, and says of none what is accepted.
template<class T>
CLI::Option* add_number(CLI::App& app, const Option& option, T& target) {
    CLI::Option* added = app.add_option_function<std::string>(
        option.names,
        [&option, &target](const std::string& text) {
            target = static_cast<Number<T>>(option_number(option, text));
        },
        help_text(option));
    added->type_name(option.rules.domain->whole ? "INT" : "FLOAT");
    if constexpr (std::is_arithmetic_v<T>) added->default_str(fmt::format("{}", target));
    return added;
}

template<class T>
CLI::Option* add_value(CLI::App& app, const Option& option, T& target) {
    if constexpr (std::is_arithmetic_v<Number<T>>) {
        return add_number(app, option, target);
    } else {
        CLI::Option* added = app.add_option(option.names, target, help_text(option));
        if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            // Without this a list would swallow the arguments behind it.
            if (!is_positional(option)) added->allow_extra_args(false);
            if (option.rules.delimiter != 0) added->delimiter(option.rules.delimiter);
        } else {
            added->check([](const std::string& text) {
                return text.empty() ? "nothing is given (accepted: a text that is not empty)" : "";
            });
        }
        if constexpr (std::is_same_v<T, std::string>)
            if (!target.empty()) added->capture_default_str();
        return added;
    }
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

/// All names of the options of a subcommand, with dashes.
std::vector<std::string> option_names(const Subcommand& subcommand) {
    std::vector<std::string> names;
    for (const Option& option : subcommand.options)
        for (std::string& name : dashed_names(option))
            names.push_back(std::move(name));
    return names;
}

/// Of arguments that nothing takes, in their order; the library tells them backwards.
std::string unknown_arguments(const Subcommand& subcommand, const std::vector<std::string>& left) {
    std::string message = fmt::format("command line: {} does not take {}", subcommand.name,
                                      in_quotes(fmt::format("{}", fmt::join(left, " "))));
    for (const std::string& argument : left) {
        if (!argument.starts_with("-")) continue;
        const std::string name = argument.substr(0, argument.find('='));
        const std::string nearest = nearest_name(name, option_names(subcommand));
        if (!nearest.empty()) return fmt::format("{}; did you mean {}?", message, nearest);
        break;
    }
    return fmt::format("{} (parhelion {} --help lists what it does)", message, subcommand.name);
}

/// What to type instead, where the first argument names no subcommand.
void check_subcommand(const CommandLine& command_line, const std::vector<std::string>& arguments) {
    std::vector<std::string> names;
    for (const Subcommand& subcommand : command_line.subcommands)
        names.push_back(subcommand.name);
    const std::string there_are = fmt::format("there are {}", fmt::join(names, ", "));
    if (arguments.empty())
        throw InputError(fmt::format("command line: no subcommand ({}; --help says more); try {}",
                                     there_are, command_line.example));
    const std::string& first = arguments.front();
    if (first.starts_with('-') || std::find(names.begin(), names.end(), first) != names.end())
        return;
    const std::string nearest = nearest_name(first, names);
    throw InputError(fmt::format(
        "command line: {} is no subcommand ({}); {}", in_quotes(first), there_are,
        nearest.empty() ? "try " + command_line.example : "did you mean " + nearest + "?"));
}

} // namespace

struct CommandLineReader::App : CLI::App {
    using CLI::App::App;
};

bool takes_number(const Option& option) {
    return std::visit(
        [](const auto* target) {
            using Type = Number<std::decay_t<decltype(*target)>>;
            return std::is_arithmetic_v<Type> && !std::is_same_v<Type, bool>;
        },
        option.target);
}

CommandLineReader::CommandLineReader(const CommandLine& command_line)
    : command_line_(command_line),
      app_(std::make_unique<App>(command_line.summary, command_line.program)) {
    app_->require_subcommand(1);
    app_->set_version_flag("--version", command_line.version);
    app_->footer(command_line.footer);
    for (const Subcommand& subcommand : command_line.subcommands)
        add_subcommand(*app_, subcommand, exit_code_);
}

CommandLineReader::~CommandLineReader() = default;

int CommandLineReader::run(std::vector<std::string> arguments) {
    exit_code_ = 0;
    check_subcommand(command_line_, arguments);
    std::reverse(arguments.begin(), arguments.end()); // as CLI::App::parse wants them
    try {
        app_->parse(arguments);
    } catch (const CLI::ExtrasError& e) {
        const auto chosen = app_->get_subcommands();
        for (const Subcommand& subcommand : command_line_.subcommands)
            if (!chosen.empty() && chosen.front()->get_name() == subcommand.name)
                throw InputError(unknown_arguments(subcommand, arguments));
        throw InputError(e.what());
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) { // help or version
            std::ostringstream text;
            const int code = app_->exit(e, text, text);
            if (command_line_.print) command_line_.print(text.str());
            return code;
        }
        throw InputError(e.what());
    }
    return exit_code_;
}

int run_command_line(const CommandLine& command_line, std::vector<std::string> arguments) {
    return CommandLineReader(command_line).run(std::move(arguments));
}

} // namespace parhelion
