// Kernels compiled by two processes, ahead or beside, and by several programs at once: found by the
// next one, whole, and the same.
#include "host/image/exr.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>

using namespace parhelion;
namespace fs = std::filesystem;

namespace {

/// Empty caches, ours and PoCL's, and pictures of the Cornell box made with them.
class ColdStart {
public:
    ColdStart() { fs::create_directories(folder_ / "pocl"); }
    ColdStart(const ColdStart&) = delete;
    ~ColdStart() { fs::remove_all(folder_); }

    int run(const std::string& arguments) const {
        return std::system(fmt::format("PARHELION_CACHE_DIR='{0}/own' POCL_CACHE_DIR='{0}/pocl' "
                                       "'{1}' {2}",
                                       folder_.string(), PARHELION_PROGRAM, arguments)
                               .c_str());
    }
    int render(const std::string& name) const {
        return run(fmt::format("render '{}' --spp 2 --size 32x24 --quiet -o '{}' --stats '{}'",
                               scene, (folder_ / (name + ".exr")).string(),
                               (folder_ / (name + ".json")).string()));
    }
    nlohmann::json stats(const std::string& name) const {
        std::ifstream in(folder_ / (name + ".json"));
        return nlohmann::json::parse(in);
    }
    std::vector<float> red(const std::string& name) const {
        Image image = read_exr((folder_ / (name + ".exr")).string());
        return find_channel(image, "R")->values;
    }
    bool nothing_half_written() const {
        for (const auto& entry : fs::directory_iterator(folder_ / "own"))
            if (entry.path().extension() != ".program") return false;
        return true;
    }

    const std::string scene = PARHELION_SOURCE_DIR "/scenes/cornell-box/scene.xml";

private:
    fs::path folder_ = fs::temp_directory_path() / fmt::format("parhelion-compile-{}", getpid());
};

} // namespace

TEST_CASE("compile: renders find the kernels ready", "[render]") {
    ColdStart cold;
    REQUIRE(cold.run("compile --quiet '" + cold.scene + "'") == 0);
    CHECK(cold.nothing_half_written());
    REQUIRE(cold.render("warm") == 0);
    CHECK(cold.stats("warm")["time"]["compile_cached"] == true);
    CHECK(cold.stats("warm")["memory"]["compiler_peak_bytes"] == 0);
}

TEST_CASE("compile: several programs from one empty cache, at once", "[render]") {
    ColdStart cold;
    std::vector<std::future<int>> renders;
    for (const char* name : {"a", "b"})
        renders.push_back(std::async(std::launch::async, &ColdStart::render, &cold, name));
    for (auto& render : renders)
        REQUIRE(render.get() == 0);
    CHECK(cold.nothing_half_written());
    CHECK(cold.red("a") == cold.red("b"));
    REQUIRE(cold.render("warm") == 0);
    CHECK(cold.stats("warm")["time"]["compile_cached"] == true);
    CHECK(cold.red("warm") == cold.red("a"));
}

TEST_CASE("compile: what cannot be compiled is refused", "[render]") {
    ColdStart cold;
    for (const char* arguments : {"", "--features faure '{}'", "--features no_such_feature",
                                  "--features none --program no_such_program"}) {
        CAPTURE(arguments);
        std::string command = fmt::format(fmt::runtime(arguments), cold.scene);
        CHECK(WEXITSTATUS(cold.run("compile " + command + " 2> /dev/null")) == 2);
    }
}
