// `parhelion info` of films: what it says is what the film was made with.
#include "host/commands/film_info.h"
#include "host/commands/info.h"
#include "host/error.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <unistd.h>

using namespace parhelion;

namespace {

/// A film with nothing on it.
struct NoSums : FilmSums {
    void add_row(int, int, SumRow&) const override {}
    void add_coverage(int, ShapeWeights&) const override {}
};

/// Of 4 blocks.
FilmHeader header_of(const std::string& part_name, const SampleSet& part,
                     const SampleSet& samples) {
    FilmHeader header;
    header.key = {{"the scene", "0123"}, {"--max-depth", "3"}};
    Film& film = header.content.film;
    film.width = 20, film.height = 10;
    film.crop_x = 2, film.crop_y = 1, film.crop_width = film.crop_height = 8;
    header.content.aovs.light_groups = {{"light.key", 0}};
    header.content.aovs.channels = 3;
    header.blocks = 4, header.samples_per_pixel = 64;
    header.part_name = part_name, header.part = part;
    header.state.samples = samples;
    header.state.counts[statistic_camera_rays] = 12345678901;
    header.state.counts[statistic_shadow_rays] = 2;
    header.state.counts[static_cast<int>(statistic_first_fault) + fault_bsdf] = 5;
    header.metadata = {{"device", std::string("a device")},
                       {"seed", std::int64_t{7}},
                       {"notes", std::string("one\ntwo")}};
    return header;
}

struct File {
    std::string name;
    explicit File(const std::string& extension)
        : name(std::filesystem::temp_directory_path() /
               fmt::format("film-info-{}{}", getpid(), extension)) {}
    ~File() { std::filesystem::remove(name); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    void write(const std::string& bytes) const {
        std::ofstream(name, std::ios::binary | std::ios::trunc) << bytes;
    }
};

nlohmann::json info_of(const FilmHeader& header) {
    const File file(".film");
    write_film(file.name, header, NoSums{}, Existing::replace);
    return describe_film(FilmFile(file.name));
}

/// What the subcommand throws for a file; nothing where it does not.
std::string refusal(const std::vector<std::string>& arguments) {
    CommandLine line;
    line.subcommands = {info_subcommand()};
    std::vector<std::string> all{"info"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    try {
        run_command_line(line, all);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("Film info: picture, layers, key and counts", "[info]") {
    const nlohmann::json info = info_of(header_of("", {{0, 4, 0, 64}}, {{0, 4, 0, 64}}));
    CHECK(info["picture"]["width_pixels"] == 20);
    CHECK(info["picture"]["height_pixels"] == 10);
    CHECK(info["picture"]["crop"] ==
          nlohmann::json({{"x", 2}, {"y", 1}, {"width_pixels", 8}, {"height_pixels", 8}}));
    CHECK(info["picture"]["layers"] ==
          nlohmann::json::parse(R"([{"name": "image", "components": ["R", "G", "B"]},
                                    {"name": "light.key", "components": ["R", "G", "B"]}])"));
    CHECK(info["key"][1] == nlohmann::json({{"name", "--max-depth"}, {"value", "3"}}));
    CHECK(info["counts"]["paths"] == 12345678901);
    CHECK(info["counts"]["rays"] == 12345678903);
    CHECK(info["counts"]["non_finite_samples"] == 5);
    CHECK(info["counts"]["faults"].size() == 1);
    CHECK(info["metadata"]["seed"] == 7);
    const std::string text = film_text(info);
    for (const char* told : {"20 x 10 pixels, of which 8 x 8 at 2,1, 64 spp", "the whole render",
                             "finished: all", "image (R G B), light.key (R G B)", "--max-depth 3",
                             "a device", "12345678901 paths", "5 of bsdf in", "  note       two\n"})
        CHECK_THAT(text, Catch::Contains(told));
}

TEST_CASE("Film info: how much is on it, of the part and of the whole", "[info]") {
    const SampleSet all{{0, 4, 0, 64}};
    SECTION("nothing") {
        const nlohmann::json samples = info_of(header_of("", all, {}))["samples"];
        CHECK(samples == nlohmann::json({{"share_of_part", 0.0},
                                         {"share_of_whole", 0.0},
                                         {"fewest_per_pixel", 0},
                                         {"finished", false}}));
    }
    SECTION("a part by blocks, whose first block has more than the second") {
        const nlohmann::json info =
            info_of(header_of("2/2 by blocks", {{2, 4, 0, 64}}, {{2, 3, 0, 32}, {3, 4, 0, 16}}));
        CHECK(info["part"] == "2/2 by blocks");
        CHECK(info["samples"]["share_of_part"] == 0.375);
        CHECK(info["samples"]["share_of_whole"] == 0.1875);
        CHECK(info["samples"]["fewest_per_pixel"] == 16);
        CHECK(info["samples"]["finished"] == false);
        CHECK_THAT(film_text(info), Catch::Contains("37.50 % of the part, 18.75 % of the whole; at "
                                                    "least 16 a pixel; not finished"));
    }
    SECTION("a part by samples, finished") {
        const nlohmann::json info =
            info_of(header_of("2/4 by samples", {{0, 4, 16, 32}}, {{0, 4, 16, 32}}));
        CHECK(info["samples"]["share_of_part"] == 1.0);
        CHECK(info["samples"]["share_of_whole"] == 0.25);
        CHECK(info["samples"]["fewest_per_pixel"] == 16);
        CHECK(info["samples"]["finished"] == true);
    }
    SECTION("two parts added up") {
        const SampleSet both{{0, 1, 0, 64}, {3, 4, 0, 64}};
        const nlohmann::json info = info_of(header_of("", both, both));
        CHECK(info["part"].is_null());
        CHECK(info["samples"]["fewest_per_pixel"] == 64);
        CHECK_THAT(film_text(info), Catch::Contains("several parts of a render"));
    }
    SECTION("all but one sample is not told as all") {
        FilmHeader header = header_of("", {{0, 4, 0, 100000}}, {{0, 4, 0, 99999}});
        header.samples_per_pixel = 100000;
        CHECK_THAT(film_text(info_of(header)), Catch::Contains("99.99 %"));
    }
}

TEST_CASE("Film info: a film is told by its first bytes, whatever it is called", "[info]") {
    const SampleSet all{{0, 4, 0, 64}};
    const std::string bytes = film_bytes(header_of("", all, all), NoSums{});
    const File film(".film"), scene(".xml");
    film.write(bytes), scene.write(bytes);
    CHECK(is_to_be_film(film.name));
    CHECK(is_to_be_film(scene.name));
    CHECK_THAT(refusal({scene.name, "--spp", "4"}), Catch::Contains("--spp: is for scenes"));
    CHECK_THAT(refusal({scene.name, "--estimate"}), Catch::Contains("--estimate: is for scenes"));
    CHECK_THAT(refusal({scene.name, "--check"}), Catch::Contains("--check: is for scenes"));

    scene.write("<scene version=\"3.0.0\"/>");
    CHECK_FALSE(is_to_be_film(scene.name));
    CHECK_FALSE(is_to_be_film("/dev/null"));
    CHECK_FALSE(is_to_be_film("there is no such file.xml"));
}

TEST_CASE("Film info: what is called a film and is none, or a damaged one, is refused", "[info]") {
    const SampleSet all{{0, 4, 0, 64}};
    const std::string bytes = film_bytes(header_of("", all, all), NoSums{});
    const File film(".film");
    for (const std::string& wrong :
         {std::string(), std::string("<scene version=\"3.0.0\"/>"), bytes.substr(0, 8),
          bytes.substr(0, bytes.size() - 1), "x" + bytes.substr(1)}) {
        film.write(wrong);
        CHECK_THAT(refusal({film.name}),
                   Catch::StartsWith(film.name + ": is no whole film of this program: "));
    }
    CHECK_THAT(refusal({"missing.film"}), Catch::Contains("cannot be opened"));
    CHECK_THAT(refusal({"missing.xml"}), Catch::Contains("no such file"));
}
