// What a subcommand tells the command line: its options, its help, and what to run.
//
// The only file that knows the parsing library is command_line.cpp.
#pragma once

#include "host/domain.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace parhelion {

/// Where the value of an option goes. A bool is a flag.
using OptionTarget = std::variant<bool*, int*, double*, std::string*, std::optional<int>*,
                                  std::optional<std::uint32_t>*, std::optional<double>*,
                                  std::optional<std::string>*, std::vector<std::string>*>;

/// What stands in the text of an option or a positional.
enum class ValueKind { text, file, folder };

struct OptionRules {
    bool required = false;
    std::vector<std::string> needs{}; ///< options that must be given with it
    char delimiter = 0;               ///< between the values of a list; 0: one value an occurrence
    std::string group{};              ///< heading in the help; empty: the usual one
    bool of_samples = false;          ///< has a say in what a sample of a pixel is
    bool of_film = false;             ///< has a say in what is on the film besides
    /// Where its number may lie, or each of the numbers in its text; absent: a text without.
    std::optional<Domain> domain{};
    ValueKind kind = ValueKind::text; ///< what a shell completes it by, if not by these:
    std::vector<std::string> words{}; ///< all that it accepts, or what is usual
};

/// One row of a subcommand's table.
struct Option {
    std::string names; ///< "-o,--output"; without dashes: positional; "!--no-x": a flag that clears
    OptionTarget target;
    std::string help;
    OptionRules rules{};
};

/// The options under a heading of their own in the help.
inline std::vector<Option> in_group(const std::string& heading, std::vector<Option> options) {
    for (Option& option : options)
        option.rules.group = heading;
    return options;
}

struct Subcommand {
    std::string name{}, summary{};
    std::string examples{}; ///< printed below the options
    std::vector<Option> options{};
    std::function<int()> run{}; ///< returns the exit code; owns what the options point to
};

struct CommandLine {
    std::string program = "parhelion"; ///< what it is started as
    std::string summary{}, footer{};
    std::string example{};                  ///< of a whole command line
    std::function<std::string()> version{}; ///< what --version prints
    std::vector<Subcommand> subcommands{};
    std::function<void(const std::string&)> print{}; ///< of help and version
};

/// Reads command lines, one after the other. To be made takes much longer than to read one.
class CommandLineReader {
public:
    /// Of `command_line`, which must outlive it.
    explicit CommandLineReader(const CommandLine& command_line);
    ~CommandLineReader();
    CommandLineReader(const CommandLineReader&) = delete;
    CommandLineReader& operator=(const CommandLineReader&) = delete;

    /// Fills the targets of the subcommand named in `arguments` (without the program's name) and
    /// runs it; prints help and version where asked for. Targets of options that are not given stay
    /// as they are. Returns the exit code. Throws InputError for a command line that cannot be
    /// understood; what the subcommand throws passes through.
    int run(std::vector<std::string> arguments);

private:
    struct App; // the library's
    const CommandLine& command_line_;
    std::unique_ptr<App> app_;
    int exit_code_ = 0;
};

/// Whether the option takes one number, and not a flag or a text.
bool takes_number(const Option& option);

/// Reads one command line and runs it.
int run_command_line(const CommandLine& command_line, std::vector<std::string> arguments);

} // namespace parhelion
