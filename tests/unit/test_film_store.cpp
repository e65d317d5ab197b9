// Films on a disk while they are rendered: what is read is the sum of all that was added, without
// error; a disk that is full is told of.
#include "host/error.h"
#include "host/film/film_file.h"
#include "host/film/film_store.h"
#include "tests/support/known_film.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>

#include <sys/resource.h>

using namespace parhelion;
using namespace parhelion::test;

namespace {

std::string folder() { return std::filesystem::temp_directory_path().string(); }

/// Rows [first, end) of a film, of the others nothing.
class SomeRows : public FilmSums {
public:
    SomeRows(const FilmSums& film, int first, int end) : film_(film), first_(first), end_(end) {}
    void add_row(int channel, int y, SumRow& row) const override {
        if (y >= first_ && y < end_) film_.add_row(channel, y, row);
    }

private:
    const FilmSums& film_;
    int first_, end_;
};

/// A weight for each row, of a shape of its number.
class Covered : public FilmSums {
public:
    void add_row(int, int, SumRow&) const override {}
    void add_coverage(int y, ShapeWeights& row) const override {
        row.push_back({y % width, y, 100 + y});
        row.push_back({0, y, 7});
    }
};

bool same_films(const FilmSums& a, const FilmSums& b) {
    bool same = true;
    for (int channel = 0; channel < channels; channel++)
        for (int y = 0; y < height; y++) {
            SumRow of_a(width), of_b(width);
            a.add_row(channel, y, of_a);
            b.add_row(channel, y, of_b);
            for (int k = 0; k < EXACT_WORDS; k++)
                for (int x = 0; x < width; x++)
                    same &= of_a.digit(k)[x] == of_b.digit(k)[x];
        }
    return same;
}

/// Of the files of this process for as long as it lives, bytes.
class FileLimit {
public:
    explicit FileLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
    }
    ~FileLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileLimit(const FileLimit&) = delete;
    FileLimit& operator=(const FileLimit&) = delete;

private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

} // namespace

TEST_CASE("A store of a film has the sum of what was added to it", "[film]") {
    const KnownFilm a(1), b(2), c(3);
    FilmStore store(folder(), width, height, channels);
    CHECK(same_films(store, AddedFilms({})));
    store.add(a, 0, height);
    CHECK(same_films(store, a));
    store.add(b, 0, 2);
    store.add(c, 1, 1);
    store.add(c, 1, 3);
    const SomeRows of_b(b, 0, 2), of_c(c, 1, 3);
    CHECK(same_films(store, AddedFilms({&a, &of_b, &of_c})));
    CHECK(store.bytes() > 0);
    // Not what it is not.
    CHECK_FALSE(same_films(store, AddedFilms({&a, &b, &of_c})));
}

TEST_CASE("A store of a film has what shapes cover", "[film]") {
    const Covered covered;
    FilmStore store(folder(), width, height, channels);
    store.add(covered, 0, height);
    store.add(covered, 1, 2);
    for (int y = 0; y < height; y++) {
        ShapeWeights wanted, found;
        covered.add_coverage(y, wanted);
        if (y == 1) covered.add_coverage(y, wanted);
        store.add_coverage(y, found);
        add_up(wanted), add_up(found);
        CHECK(found == wanted);
    }
}

TEST_CASE("A store without a disk is refused, and one whose disk is full is told of", "[film]") {
    CHECK_THROWS_AS(FilmStore("/nowhere/at/all", width, height, channels), OutputError);
    FilmStore store(folder(), width, height, channels);
    const KnownFilm film(4);
    {
        const FileLimit limit(40);
        CHECK_THROWS_AS(store.add(film, 0, height), OutputError);
    }
    CHECK(free_disk_bytes(folder()) > 0);
    CHECK(free_disk_bytes("/nowhere/at/all") == 0);
}

TEST_CASE("Digits in use of a row are those between the first and the last", "[film]") {
    SumRow row(width);
    CHECK(digits_in_use(row).count == 0);
    row.digit(3)[2] = 1;
    CHECK((digits_in_use(row).first == 3 && digits_in_use(row).count == 1));
    row.digit(EXACT_WORDS - 1)[0] = 5;
    CHECK((digits_in_use(row).first == 3 && digits_in_use(row).count == EXACT_WORDS - 3));
    row.digit(0)[4] = 7;
    CHECK((digits_in_use(row).first == 0 && digits_in_use(row).count == EXACT_WORDS));
}
