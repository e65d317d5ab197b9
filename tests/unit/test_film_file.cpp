// Films in files: what is read is what was written; what is damaged, cut off or of another render
// is refused.
#include "host/error.h"
#include "host/film/film_parts.h"
#include "host/numerics/measure.h"
#include "tests/support/known_film.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <unistd.h>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

FilmHeader header_of(const SampleSet& samples) {
    FilmHeader header;
    header.key = {{"the scene", "0123"}, {"--seed", "7"}};
    header.content.film.width = header.content.film.crop_width = width;
    header.content.film.height = header.content.film.crop_height = height;
    header.blocks = 2, header.samples_per_pixel = 64;
    header.part = header.state.samples = samples;
    header.state.counts[statistic_camera_rays] = 12345678901;
    header.state.bad_samples = {{1, 2, 3, fault_bsdf, 4}};
    header.metadata = {{"device", std::string("a")}, {"n", std::int64_t{3}}, {"x", 0.5}};
    return header;
}

struct File {
    std::string name =
        std::filesystem::temp_directory_path() / fmt::format("film-{}.film", getpid());
    ~File() { std::filesystem::remove(name); }

    std::string bytes() const {
        std::ifstream in(name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void write(const std::string& bytes) const {
        std::ofstream(name, std::ios::binary | std::ios::trunc) << bytes;
    }
};

/// Reads all of a file.
void read_all(const std::string& file) {
    const FilmFile film(file);
    for (int y = 0; y < height; y++)
        for (int channel = 0; channel < channels; channel++) {
            SumRow row(width);
            film.add_row(channel, y, row);
        }
}

} // namespace

TEST_CASE("Film files: what is read is what was written") {
    const File file;
    const KnownFilm film(1);
    const FilmHeader header = header_of({{0, 2, 0, 16}});
    write_film(file.name, header, film, Existing::replace);
    const FilmFile read(file.name);
    CHECK(read.header().key == header.key);
    CHECK(read.header().metadata == header.metadata);
    CHECK(read.header().state.samples == header.state.samples);
    CHECK(read.header().state.counts == header.state.counts);
    CHECK(read.header().state.bad_samples.at(0).fault == fault_bsdf);
    int something = 0;
    for (int y = 0; y < height; y++)
        for (int channel = 0; channel < channels; channel++)
            for (int x = 0; x < width; x++) {
                CHECK(value(read, channel, y, x) == value(film, channel, y, x));
                something += value(film, channel, y, x) != 0;
            }
    CHECK(something > 30);
}

TEST_CASE("Film files: films add up, whatever their signs and sizes") {
    const KnownFilm a(1), b(2);
    const AddedFilms both({&a, &b, &a});
    for (int y = 0; y < height; y++)
        for (int channel = 0; channel < channels; channel++)
            for (int x = 0; x < width; x++) {
                const double wanted = 2 * value(a, channel, y, x) + value(b, channel, y, x);
                CHECK(value(both, channel, y, x) == Approx(wanted).epsilon(1e-14));
            }
}

TEST_CASE("Film files: one that is damaged or cut off anywhere is refused") {
    const File file;
    write_film(file.name, header_of({{0, 2, 0, 16}}), KnownFilm(1), Existing::replace);
    const std::string bytes = file.bytes();
    CHECK_NOTHROW(read_all(file.name));
    for (std::size_t at = 0; at < bytes.size(); at++) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        file.write(damaged);
        CAPTURE(at);
        CHECK_THROWS_AS(read_all(file.name), InputError);
    }
    for (std::size_t size = 0; size < bytes.size(); size += 3) {
        file.write(bytes.substr(0, size));
        CAPTURE(size);
        CHECK_THROWS_AS(read_all(file.name), InputError);
    }
    file.write(bytes + "x");
    CHECK_THROWS_AS(read_all(file.name), InputError);
    CHECK_THROWS_WITH(FilmFile("/nonexistent.film"), Catch::Contains("No such file"));
    CHECK_THROWS_AS(FilmFile("/"), InputError);
}

TEST_CASE("Film files: parts that are double, missing or of another render are named") {
    const KnownFilm film(1);
    const std::string base =
        std::filesystem::temp_directory_path() / fmt::format("parts-{}-", getpid());
    auto part = [&](const std::string& name, const FilmHeader& header) {
        write_film(base + name, header, film, Existing::replace);
        return base + name;
    };
    FilmHeader first = header_of({{0, 1, 0, 64}}), second = header_of({{1, 2, 0, 64}});
    first.part_name = "1/2 by blocks", second.part_name = "2/2 by blocks";
    FilmHeader seeded = second, larger = second, stopped = second;
    seeded.key[1].second = "8";
    larger.samples_per_pixel = 65;
    stopped.state.samples = {{1, 2, 0, 32}};
    const std::string a = part("a.film", first), b = part("b.film", second),
                      c = part("c.film", seeded), d = part("d.film", larger),
                      e = part("e.film", stopped);
    auto open = [](std::initializer_list<std::string> names) {
        std::deque<FilmFile> parts;
        for (const std::string& name : names)
            parts.emplace_back(name);
        return parts;
    };
    auto missing = [&](const std::deque<FilmFile>& parts) {
        check_parts(parts);
        return missing_text(parts, added_header(parts));
    };
    CHECK(missing(open({a, b})).empty());
    CHECK(missing(open({b, a})).empty());
    CHECK(missing(open({b})) == "50.00 % of the samples are missing: there is no file of part 1/2");
    CHECK(missing(open({a, e})) == "25.00 % of the samples are missing: not finished: " + e);
    CHECK_THROWS_WITH(missing(open({a, b, a})), Catch::StartsWith(a + ": is given twice"));
    const std::string f = part("f.film", first);
    CHECK_THROWS_WITH(missing(open({a, b, f})), Catch::StartsWith(f + ": has samples that " + a));
    std::filesystem::remove(f);
    CHECK_THROWS_WITH(missing(open({a, c})), Catch::Contains("--seed: 7 there, 8 here"));
    CHECK_THROWS_WITH(missing(open({a, d})), Catch::Contains("is of 65 samples a pixel"));
    for (const char* name : {"3", "1/", "/2", "1/99999999999 by", "x/y by", "2/2 by blocks"}) {
        FilmHeader named = second;
        named.part_name = name;
        CHECK_THAT(missing(open({part("b.film", named)})),
                   Catch::StartsWith("50.00 % of the samples are missing"));
    }
    const FilmHeader added = added_header(open({a, b}));
    CHECK(added.state.counts[statistic_camera_rays] == 2 * 12345678901ULL);
    for (const std::string& name : {a, b, c, d, e})
        std::filesystem::remove(name);
}
