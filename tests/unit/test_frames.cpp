// The renders of one command line: which there are, in which order, and the command of each.
#include "host/commands/frames.h"
#include "host/commands/number_ranges.h"
#include "host/error.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using Catch::Matchers::Contains;

namespace {

RenderCommand parsed(std::vector<std::string> arguments) {
    auto command = std::make_shared<RenderCommand>();
    CommandLine line;
    line.subcommands.push_back({"render", "", "", render_options(*command), [] { return 0; }});
    arguments.insert(arguments.begin(), "render");
    CHECK(run_command_line(line, arguments) == 0);
    return *command;
}

std::vector<std::string> outputs(const std::vector<std::string>& arguments) {
    const Frames frames(parsed(arguments));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < frames.count(); i++)
        names.push_back(frames.command(i).output);
    return names;
}

const std::string scenes = PARHELION_SOURCE_DIR "/scenes/";
const std::string box = scenes + "cornell-box/scene.xml", hall = scenes + "sunlit/hall.xml";

} // namespace

TEST_CASE("Several renders: scenes, then sweeps as given, then frames") {
    using Names = std::vector<std::string>;
    CHECK(outputs({"s.xml"}) == Names{"out.exr"});
    CHECK(outputs({"s.xml", "-o", "$scene.exr"}) == Names{"s.exr"});
    CHECK(outputs({"s.xml", "-o", "##.exr", "--frames", "3"}) == Names{"03.exr"});
    CHECK(outputs({"s.xml", "-o", "$b$a$frame", "-D", "a=1:1:2", "-D", "b=5:1:6", "--frames",
                   "8-9"}) == Names{"518", "519", "618", "619", "528", "529", "628", "629"});
    CHECK(outputs({box, hall, "-o", "$folder/$scene-$a", "-D", "a=0:1:1"}) ==
          Names{"cornell-box/scene-0", "cornell-box/scene-1", "sunlit/hall-0", "sunlit/hall-1"});
    CHECK(outputs({"s.xml", "-o", "$frame", "-D", "frame=1:2:5"}) == Names{"1", "3", "5"});
    // The last of a name counts, and a name of one's own is before those that there are anyway.
    CHECK(outputs({"s.xml", "-o", "$a", "-D", "a=0:1:9", "-D", "a=7"}) == Names{"7"});
    CHECK(outputs({"s.xml", "-o", "$scene", "-D", "scene=mine"}) == Names{"mine"});
}

TEST_CASE("Several renders: the command of one is the one that a user would give for it") {
    const Frames frames(parsed({box, hall, "-o", "$scene-%02d-$a.exr", "--stats",
                                "$scene-####-$a.json", "--checkpoint", "$scene$frame$a.film", "-D",
                                "b=x", "-D", "a=0:0.5:1", "--frames", "-1-0", "--seed", "3"}));
    REQUIRE(frames.count() == 12);
    CHECK(frames.several());
    CHECK(frames.of_scene() == 6);
    CHECK(frames.differences() == std::vector<std::string>{"$scene", "$a", "$frame"});
    const RenderCommand one = frames.command(8);
    CHECK(one.scene_file == hall);
    CHECK(one.definitions == std::vector<std::string>{"b=x", "a=0.5", "frame=-1"});
    CHECK(one.output == "hall--1-0.5.exr");
    CHECK(one.stats_file == "hall--0001-0.5.json");
    CHECK(one.checkpoint == "hall-10.5.film");
    CHECK(one.seed == 3u);
    CHECK_FALSE(one.frames);
    CHECK(frames.title(8) == hall + ", a=0.5, frame=-1");
    CHECK(Frames(one).count() == 1);
    CHECK(Frames(one).command(0).output == one.output);
    CHECK_THROWS_WITH(frames.only("--trace"), Contains("--trace") && Contains("there are 12"));
    CHECK(Frames(parsed({"s.xml", "-D", "a=1", "--frames", "4"})).only("--trace").definitions ==
          std::vector<std::string>{"a=1", "frame=4"});
}

TEST_CASE("Several renders: what is none is refused") {
    const auto refused = [](const std::vector<std::string>& arguments, const std::string& what) {
        INFO(what);
        CHECK_THROWS_WITH(Frames(parsed(arguments)), Contains(what));
    };
    refused({"s.xml", "-D", "frame=3", "--frames", "1-2"}, "--frames gives $frame its value");
    refused({"s.xml", "-D", "a"}, "expected name=value");
    refused({"s.xml", "-D", "=0:1:2"}, "expected name=value");
    refused({"s.xml", "-D", "a=0:0:2"}, "-D a=0:0:2: has no value");
    refused({box, hall, box}, "is given twice");
    refused({box, "missing.xml"}, "missing.xml: no such file");
    refused({box, ""}, "a scene without a name");
    refused({"s.xml", "-D", "a=1:1:1000", "--frames", "1-101"}, "too many renders");
    refused({box, hall, "-D", "a=1:1:100000"}, "too many renders");
    CHECK(Frames(parsed({"s.xml", "-D", "a=1:1:1000", "--frames", "1-100"})).count() ==
          most_renders);
    CHECK_THROWS_WITH(Frames(parsed({"s.xml", "-o", "$b.exr"})).command(0), Contains("\"$b\""));
}
