// `parhelion completion`: scripts for shells, made from the option tables.
#include "host/commands/completion.h"

#include "host/commands/option_text.h"
#include "host/error.h"
#include "host/streams.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <memory>

namespace parhelion {
namespace {

constexpr std::array<std::string_view, 2> shells{"bash", "zsh"};

int run_completion(const std::string& shell, const CommandLine& command_line) {
    if (shell == "bash")
        print(bash_completion(command_line));
    else if (shell == "zsh")
        print(zsh_completion(command_line));
    else
        throw InputError(
            fmt::format("completion '{}': there are {}", shell, fmt::join(shells, ", ")));
    return static_cast<int>(ExitCode::ok);
}

} // namespace

Subcommand completion_subcommand(const std::function<CommandLine()>& command_line) {
    auto shell = std::make_shared<std::string>();
    return {
        .name = "completion",
        .summary = "Print the script by which a shell completes command lines of this program",
        .examples = "Examples:\n"
                    "  source <(parhelion completion bash)   # in ~/.bashrc\n"
                    "  parhelion completion zsh >~/.zfunc/_parhelion   # a folder of fpath",
        .options = {{"shell",
                     shell.get(),
                     "bash or zsh",
                     {.required = true, .words = {shells.begin(), shells.end()}}}},
        .run = [shell, command_line] { return run_completion(*shell, command_line()); },
    };
}

} // namespace parhelion
