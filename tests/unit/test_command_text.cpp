// Commands told to the user, as a shell reads them.
#include "host/commands/command_text.h"
#include "host/commands/render.h"

#include <catch2/catch.hpp>

using namespace parhelion;

namespace {

/// The arguments of a command line that a shell makes of single quotes and blanks.
std::vector<std::string> as_a_shell(const std::string& text) {
    std::vector<std::string> words;
    bool quoted = false, open = false;
    for (std::size_t i = 0; i < text.size(); i++) {
        char c = text[i];
        if (!quoted && c == ' ') {
            open = false;
            continue;
        }
        if (!open) words.emplace_back();
        open = true;
        if (c == '\'')
            quoted = !quoted;
        else
            words.back() += !quoted && c == '\\' ? text[++i] : c;
    }
    return words;
}

std::string given_options(RenderCommand command) {
    std::string text;
    for (const Option& option : render_options(command))
        text += given_option(option);
    return text;
}

RenderCommand read(const std::vector<std::string>& arguments) {
    RenderCommand command;
    CommandLine line{
        .subcommands = {
            {.name = "render", .options = render_options(command), .run = [] { return 0; }}}};
    REQUIRE(run_command_line(line, arguments) == 0);
    return command;
}

} // namespace

TEST_CASE("Given options: read again, they say the same") {
    CHECK(given_options({}).empty());
    const std::vector<std::string> arguments = {
        "render",           "scene.xml",          "--spp=16",
        "--size=4x3",       "--integrator=path",  "--no-next-event",
        "--allow-outside",  "--aov=albedo,depth", "-Da=it's 1",
        "--define=b=$HOME", "--exposure=-0.5",    "--seed=4294967295"};
    const std::string text = given_options(read(arguments));
    for (const char* part : {" --spp 16", " --size 4x3", " --no-next-event", " --allow-outside",
                             " --aov albedo,depth", " --define 'a=it'\\''s 1'",
                             " --define 'b=$HOME'", " --seed 4294967295", " --exposure -0.5"})
        CHECK(text.find(part) != std::string::npos);
    const RenderCommand again = read(as_a_shell("render scene.xml" + text));
    CHECK(again.definitions == std::vector<std::string>{"a=it's 1", "b=$HOME"});
    CHECK(given_options(again) == text);
}

TEST_CASE("Given options: those that have a say in samples are marked") {
    RenderCommand command;
    std::string marked;
    for (const Option& option : render_options(command))
        if (option.rules.of_samples) marked += option.names + " ";
    for (const char* name : {"--spp", "--size", "--seed", "--integrator", "--max-depth",
                             "--no-next-event", "--aov", "--define", "--sampler", "--filter-by"})
        CHECK(marked.find(name) != std::string::npos);
    for (const char* name : {"--device", "--crop", "--streams", "--lanes", "--output"})
        CHECK(marked.find(name) == std::string::npos);
}
