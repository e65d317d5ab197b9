// The cache of compiled programs never changes an image: fresh, warm, damaged in any way, or not
// writable.
#include "host/render/path_tracer.h"
#include "tests/support/every_kind_scene.h"

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

struct Rendered {
    std::vector<float> red;
    int cached = 0;
    bool operator==(const Rendered&) const = default;
};

Rendered rendered() {
    Scene scene = every_kind_scene();
    scene.film.width = scene.film.crop_width = 16, scene.film.height = scene.film.crop_height = 12;
    scene.sampler.samples_per_pixel = 2;
    Progress quiet(Progress::Mode::quiet);
    RenderResult result = render(scene, choose_device(""), {}, quiet);
    Rendered r{find_channel(result.image, "R")->values};
    for (const StageReport& stage : result.report.stages)
        r.cached += stage.cached;
    return r;
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

TEST_CASE("The program cache: fresh, warm, damaged, not writable; the image is the same",
          "[render]") {
    CacheFolder cache;
    constexpr int stages = static_cast<int>(stage_count);
    Rendered fresh = rendered();
    CHECK(fresh.cached == 0);
    CHECK(cache.files().size() == stage_count);
    Rendered warm = rendered();
    CHECK(warm.cached == stages);
    CHECK(warm.red == fresh.red);

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
        Rendered damaged = rendered();
        CHECK(damaged.cached == 0);
        CHECK(damaged.red == fresh.red);
        Rendered repaired = rendered();
        CHECK(repaired.cached == stages);
        CHECK(repaired.red == fresh.red);
    }

    // A folder that cannot be made: below a file, so that this holds for root too.
    CacheFolder::use(cache.files().front() / "below");
    Rendered without = rendered();
    CHECK(without.cached == 0);
    CHECK(without.red == fresh.red);
    // The program's file name is taken by a folder.
    CacheFolder::use(cache.path());
    for (const fs::path& file : cache.files())
        fs::remove(file), fs::create_directories(file / "in the way");
    Rendered blocked = rendered();
    CHECK(blocked.cached == 0);
    CHECK(blocked.red == fresh.red);
}
