// Every number of every option, at the ends of its domain, inside and beyond; and the page that
// lists them.
#include "host/commands/nearest_name.h"
#include "host/commands/option_number.h"
#include "host/commands/parameters.h"
#include "host/commands/render.h"
#include "host/commands/subcommands.h"
#include "host/error.h"
#include "host/scene/text.h"
#include "tests/support/domain_values.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>
#include <type_traits>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

template<class T>
double value_of(const T& target) {
    if constexpr (std::is_arithmetic_v<T>)
        return static_cast<double>(target);
    else
        return std::nan("");
}
template<class T>
double value_of(const std::optional<T>& target) {
    return target ? value_of(*target) : std::nan("");
}

/// Options write to what `run` holds: it stays.
void do_nothing(Subcommand& subcommand) {
    subcommand.run = [kept = subcommand.run] { return kept ? 0 : 1; };
}

/// The message that the words are refused with; empty: they were read.
std::string refusal_of(const CommandLine& line, const std::vector<std::string>& words) {
    try {
        run_command_line(line, words);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// What reading needs beside the option: files that need not be there.
std::vector<std::string> words_for(const Subcommand& subcommand, const Option& option,
                                   const std::string& text) {
    std::vector<std::string> words{subcommand.name};
    for (const Option& other : subcommand.options)
        if (other.rules.required) words.emplace_back("some-file");
    for (const std::string& needed : option.rules.needs)
        for (const Option& other : subcommand.options)
            if (option_name(other) == needed) {
                words.push_back(needed);
                if (!std::holds_alternative<bool*>(other.target)) words.emplace_back("1");
            }
    if (option.names == "--trace" || option_name(option) == "--pixel")
        words.insert(words.end(), {"--sample", "1"});
    if (option_name(option) == "--sample") words.insert(words.end(), {"--pixel", "1,1"});
    words.push_back(option_name(option) + "=" + text);
    return words;
}

void check_option(const CommandLine& line, const Option& option, const TriedNumber& number) {
    const Subcommand& subcommand = line.subcommands.front();
    INFO(subcommand.name << " " << option_name(option) << "=" << number.text);
    std::string refusal = refusal_of(line, words_for(subcommand, option, number.text));
    std::optional<double> taken = placed(*option.rules.domain, number.value);
    if (taken) {
        CHECK(refusal.empty());
        CHECK(std::visit([](const auto* t) { return value_of(*t); }, option.target) == *taken);
    } else {
        CHECK_THAT(refusal, Contains(option_name(option)));
        if (!number.text.empty())
            CHECK_THAT(refusal, Contains(accepted_text(*option.rules.domain)));
        CHECK(refusal.find('\n') == std::string::npos);
    }
}

} // namespace

TEST_CASE("Domains: every option that takes a number has one", "[domains]") {
    std::size_t options = 0, walked = 0;
    for (const Subcommand& original : all_subcommands()) {
        CommandLine line{.subcommands = {original}};
        do_nothing(line.subcommands.front());
        for (const Option& option : line.subcommands.front().options) {
            INFO(original.name << " " << option.names);
            if (!takes_number(option)) continue;
            REQUIRE(option.rules.domain.has_value());
            options++;
            for (const TriedNumber& number : tried_numbers(*option.rules.domain)) {
                check_option(line, option, number);
                walked++;
            }
        }
    }
    CHECK(options >= 25);
    CHECK(walked >= 400);
}

TEST_CASE("Domains: whole numbers of options may have an exponent", "[domains]") {
    CommandLine line{.subcommands = {render_subcommand()}};
    do_nothing(line.subcommands.front());
    CHECK(refusal_of(line, {"render", "s.xml", "--spp", "1e3"}).empty());
    CHECK_THAT(refusal_of(line, {"render", "s.xml", "--spp", "1.5"}),
               Contains("--spp is \"1.5\"") && Contains("a whole number, 1 to 2147483647"));
}

TEST_CASE("Domains: film sizes and crops of the command line", "[domains]") {
    const auto refused = [](const std::string& size, const std::string& crop) {
        RenderCommand command;
        if (!size.empty()) command.size = size;
        if (!crop.empty()) command.crop = crop;
        Scene scene;
        try {
            apply_overrides(command, scene);
            return false;
        } catch (const InputError&) {
            return true;
        }
    };
    CHECK(!refused("1x1", ""));
    CHECK(!refused("65536x4096", ""));
    for (const char* size : {"0x1", "1x0", "-1x4", "65537x1", "65536x65536", "65536x4097",
                             "99999999999x1", "nanx1", "1x", "x", ""})
        CHECK((size[0] == '\0' || refused(size, "")));
    CHECK(!refused("8x8", "7,7,1,1"));
    for (const char* crop : {"8,0,1,1", "0,0,0,1", "-1,0,2,2", "0,0,9,1", "1,1,8,8",
                             "2147483647,0,1,1", "1,0,2147483647,1"})
        CHECK(refused("8x8", crop));
}

TEST_CASE("Command line: what nothing takes is told in its order, with what is near", "[domains]") {
    CommandLine line{.subcommands = {render_subcommand()}};
    do_nothing(line.subcommands.front());
    CHECK_THAT(refusal_of(line, {"render", "s.xml", "--tonemap", "--gamma"}),
               Contains("\"--tonemap --gamma\"") && Contains("render --help"));
    CHECK_THAT(refusal_of(line, {"render", "s.xml", "--sppp=3"}),
               Contains("\"--sppp=3\"") && Contains("did you mean --spp?"));
    CHECK_THAT(refusal_of(line, {"render", "s.xml", "--max-deth", "3"}),
               Contains("did you mean --max-depth?"));
    CHECK(nearest_name("--xyz", {"--spp", "--size"}).empty());
    CHECK(nearest_name("", {"--spp"}).empty());
    CHECK(nearest_name("--seed", {"--spp", "--seed"}) == "--seed");
}

TEST_CASE("Domains: docs/parameters.md is what the program says", "[domains]") {
    std::ifstream file(PARHELION_SOURCE_DIR "/docs/parameters.md");
    std::ostringstream text;
    text << file.rdbuf();
    // Otherwise: parhelion parameters > docs/parameters.md
    CHECK(text.str() == parameters_page());
}
