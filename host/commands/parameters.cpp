// `parhelion parameters`: every number that a scene file or the command line can give.
#include "host/commands/parameters.h"

#include "host/commands/option_number.h"
#include "host/commands/subcommands.h"
#include "host/error.h"
#include "host/json_text.h"
#include "host/scene/mitsuba/number_parameters.h"
#include "host/scene/text.h"
#include "host/streams.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace parhelion {
namespace {

using mitsuba::NumberParameter;

constexpr std::string_view introduction =
    "# Numbers and where they may lie\n"
    "\n"
    "`parhelion parameters` prints this page; a test holds it against the program. A number that "
    "is NaN, infinite or outside what is accepted is refused with one line and exit code 2, "
    "unless the last column says what it is taken as; then a note says so.\n";

std::string range_text(const Domain& domain, std::string_view also) {
    std::string text = accepted_text(domain);
    return also.empty() ? text : fmt::format("{}; {}", text, also);
}

std::string row(const NumberParameter& p) {
    return fmt::format("| {} | {} | `{}` | {} | {} |\n", p.tag,
                       fmt::join(split(p.plugins, " "), ", "), p.name, range_text(p.domain, p.also),
                       beyond_text(p.domain));
}

std::string row(const Subcommand& subcommand, const Option& option) {
    const Domain& domain = *option.rules.domain;
    return fmt::format("| {} | `{}` | {} | {} |\n", subcommand.name, option_name(option),
                       accepted_text(domain), beyond_text(domain));
}

nlohmann::json to_json(const Domain& domain) {
    nlohmann::json json{{"lowest", domain.lowest},
                        {"highest", domain.highest},
                        {"lowest_accepted", !domain.above_lowest},
                        {"highest_accepted", !domain.below_highest},
                        {"whole", domain.whole},
                        {"accepted", accepted_text(domain)},
                        {"beyond", beyond_text(domain)}};
    return json;
}

nlohmann::json parameters_json() {
    nlohmann::json scene = nlohmann::json::array(), options = nlohmann::json::array();
    for (const NumberParameter& p : mitsuba::number_parameters())
        scene.push_back({{"kind", p.tag},
                         {"plugins", split(p.plugins, " ")},
                         {"name", p.name},
                         {"also", p.also},
                         {"domain", to_json(p.domain)}});
    for (const Subcommand& subcommand : all_subcommands())
        for (const Option& option : subcommand.options)
            if (option.rules.domain)
                options.push_back({{"subcommand", subcommand.name},
                                   {"option", option_name(option)},
                                   {"domain", to_json(*option.rules.domain)}});
    return {{"scene", scene}, {"options", options}};
}

} // namespace

std::string parameters_page() {
    std::string page(introduction);
    page += "\n## In scene files\n\n"
            "Of colours, points and vectors each value.\n\n"
            "| kind | plugins | parameter | accepted | beyond |\n|---|---|---|---|---|\n";
    for (const NumberParameter& p : mitsuba::number_parameters())
        page += row(p);
    page += "\n## On the command line\n\n"
            "| subcommand | option | accepted | beyond |\n|---|---|---|---|\n";
    for (const Subcommand& subcommand : all_subcommands())
        for (const Option& option : subcommand.options)
            if (option.rules.domain) page += row(subcommand, option);
    return page;
}

Subcommand parameters_subcommand() {
    auto json = std::make_shared<bool>(false);
    return {
        .name = "parameters",
        .summary = "List every number of scene files and options: where it may lie, what happens "
                   "beyond",
        .examples = "Example:\n  parhelion parameters --json | jq '.scene[] | select(.name == "
                    "\"alpha\")'",
        .options = {{"--json", json.get(), "One JSON object"}},
        .run =
            [json] {
                print(*json ? json_text(parameters_json()) : parameters_page());
                return static_cast<int>(ExitCode::ok);
            },
    };
}

} // namespace parhelion
