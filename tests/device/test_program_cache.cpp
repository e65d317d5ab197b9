// The cache of compiled programs never changes a result: fresh, warm, damaged in any way, or not
// writable.
#include "host/numerics/every_kind_scene.h"
#include "host/render/device_render.h"
#include "tests/support/device.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <unistd.h>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
namespace fs = std::filesystem;

namespace {

/// A folder of its own for the cache, and the environment as it was afterwards.
class CacheFolder {
public:
    CacheFolder() {
        if (const char* old = std::getenv("PARHELION_CACHE_DIR")) before_ = old;
        fs::create_directories(path_);
        use(path_);
    }
    CacheFolder(const CacheFolder&) = delete;
    ~CacheFolder() {
        if (before_)
            use(*before_);
        else
            unsetenv("PARHELION_CACHE_DIR");
        fs::remove_all(path_);
    }
    const fs::path& path() const { return path_; }
    static void use(const fs::path& p) { setenv("PARHELION_CACHE_DIR", p.c_str(), 1); }
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(path_))
            found.push_back(entry.path());
        return found;
    }

private:
    fs::path path_ = fs::temp_directory_path() / fmt::format("parhelion-cache-{}", getpid());
    std::optional<std::string> before_;
};

struct Result {
    std::vector<float> values;
    bool cached = false;
};

/// Compiles or reads back a program, runs it and keeps it.
Result compute(const fs::path& folder) {
    static TestDevice d;
    ProgramCache cache(folder);
    Program program(d.context, d.device, cache, program_source({"self_test.cl"}, {1}));
    constexpr int count = 256;
    Buffer<float> out(d.context, "out", 2 * count);
    cl::Kernel kernel = program.kernel("self_test");
    kernel.setArg(0, out.handle());
    kernel.setArg(1, count);
    d.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count), cl::NDRange(1));
    Result r{host_copy(d, out), program.from_cache()};
    program.store(cache);
    return r;
}

std::vector<float> rendered(const CompileBeside& beside = {}) {
    Scene scene = every_kind_scene();
    scene.film.width = scene.film.crop_width = 16, scene.film.height = scene.film.crop_height = 12;
    scene.sampler.samples_per_pixel = 2;
    Progress quiet(Progress::Mode::quiet);
    RenderDevice device(choose_device(""));
    device.compile_beside = beside;
    RenderResult result = render(scene, device, {}, quiet);
    return find_channel(result.image, "R")->values;
}

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

void overwrite(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
}

} // namespace

TEST_CASE("The program cache: fresh, warm, damaged, not writable; the results are the same",
          "[device]") {
    CacheFolder cache;
    Result fresh = compute(cache.path());
    CHECK_FALSE(fresh.cached);
    CHECK(cache.files().size() == 1);
    Result warm = compute(cache.path());
    CHECK(warm.cached);
    CHECK(warm.values == fresh.values);

    struct Damage {
        const char* name;
        std::function<std::string(const std::string&)> apply;
    };
    auto turned = [](const std::string& s, std::size_t at, char bits) {
        std::string changed = s;
        changed.at(at) = static_cast<char>(changed.at(at) ^ bits);
        return changed;
    };
    const Damage damages[] = {
        {"empty", [](const std::string&) { return std::string(); }},
        {"cut in the header", [](const std::string& s) { return s.substr(0, 24); }},
        {"cut in the middle", [](const std::string& s) { return s.substr(0, s.size() / 2); }},
        {"last byte missing", [](const std::string& s) { return s.substr(0, s.size() - 1); }},
        {"a byte too many", [](const std::string& s) { return s + "x"; }},
        {"a bit turned in the binary",
         [=](const std::string& s) { return turned(s, s.size() - 100, 4); }},
        {"a bit turned in the key", [=](const std::string& s) { return turned(s, 100, 1); }},
        {"a bit turned in the sizes", [=](const std::string& s) { return turned(s, 26, 64); }},
        {"garbage", [](const std::string& s) { return std::string(s.size(), 'g'); }},
    };
    for (const Damage& damage : damages) {
        CAPTURE(damage.name);
        for (const fs::path& file : cache.files())
            overwrite(file, damage.apply(content(file)));
        Result damaged = compute(cache.path());
        CHECK_FALSE(damaged.cached);
        CHECK(damaged.values == fresh.values);
        Result repaired = compute(cache.path());
        CHECK(repaired.cached);
        CHECK(repaired.values == fresh.values);
    }

    // A folder that cannot be made: below a file, so that this holds for root too.
    Result without = compute(cache.files().front() / "below");
    CHECK_FALSE(without.cached);
    CHECK(without.values == fresh.values);
    // The program's file name is taken by a folder.
    for (const fs::path& file : cache.files())
        fs::remove(file), fs::create_directories(file / "in the way");
    Result blocked = compute(cache.path());
    CHECK_FALSE(blocked.cached);
    CHECK(blocked.values == fresh.values);
}

TEST_CASE("A render is the same with a fresh, a warm and a damaged program cache", "[device]") {
    CacheFolder cache;
    std::vector<float> fresh = rendered();
    CHECK(cache.files().size() == program_groups.size());
    CHECK(rendered() == fresh);
    for (const fs::path& file : cache.files())
        overwrite(file, "garbage");
    CHECK(rendered() == fresh);
    CacheFolder::use(cache.files().front() / "below");
    CHECK(rendered() == fresh);
}

TEST_CASE("A render is the same whatever becomes of the process that compiles beside it",
          "[device]") {
    std::vector<float> alone = [] {
        CacheFolder cache;
        return rendered();
    }();
    bool keeps = choose_device("").keeps_programs;
    const std::optional<std::vector<std::string>> commands[] = {
        std::nullopt, // cannot be started
        std::vector<std::string>{"/bin/false"},
        std::vector<std::string>{"/bin/sh", "-c", "kill -KILL $$"},
        std::vector<std::string>{"/bin/true"}, // says it has, and has not
    };
    for (const auto& command : commands) {
        CAPTURE(command ? command->front() : "none");
        CacheFolder cache;
        int asked = 0;
        CompileBeside beside = [&](ProgramGroup, const StageOptions&, const fs::path&) {
            asked++;
            return command ? ChildProcess::start(*command) : std::nullopt;
        };
        CHECK(rendered(beside) == alone);
        CHECK(asked == (keeps ? 1 : 0));
        CHECK(rendered(beside) == alone); // both programs are known now
        CHECK(asked == (keeps ? 1 : 0));
    }
}
