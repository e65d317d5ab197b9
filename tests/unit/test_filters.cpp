// Reconstruction filters as tables, how far they reach, and which pixels are sampled for a crop.
#include "host/film/sample_window.h"
#include "host/flatten/filter_table.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;

namespace {

constexpr FilterKind kinds[] = {FilterKind::box,      FilterKind::tent,       FilterKind::gaussian,
                                FilterKind::mitchell, FilterKind::catmullrom, FilterKind::lanczos};

Film film_of(FilterKind kind) {
    Film film;
    film.width = 30, film.height = 20;
    film.crop_width = 30, film.crop_height = 20;
    film.filter.kind = kind;
    return film;
}

} // namespace

TEST_CASE("Filters: interpolated values are those of the formula") {
    for (FilterKind kind : kinds) {
        if (kind == FilterKind::box) continue; // has a step, and is never splatted
        ReconstructionFilter filter = film_of(kind).filter;
        std::vector<float> values = make_filter_values(filter);
        double worst = 0;
        for (double x = 0; x <= FILTER_REACH_LIMIT + 0.5; x += 0.000173) {
            double scaled = x * FILTER_INTERVALS;
            auto n = static_cast<std::size_t>(scaled);
            double value = values[n] + (values[n + 1] - values[n]) * (scaled - double(n));
            worst = std::max(worst, std::abs(value - filter_value(filter, x)));
        }
        INFO("filter " << int(kind) << " off by " << worst);
        CHECK(worst < 2e-6);
    }
}

TEST_CASE("Filters: a sample counts as far as the filter reaches from the edge of its pixel") {
    const int reaches[] = {0, 1, 2, 2, 2, 3};
    for (std::size_t k = 0; k < std::size(kinds); k++) {
        Film film = film_of(kinds[k]);
        CHECK(filter_reach(film) == reaches[k]);
        film.filter_method = FilterMethod::sampling;
        CHECK(filter_reach(film) == 0);
    }
    Film film = film_of(FilterKind::tent);
    for (auto [radius, reach] :
         {std::pair(0.4, 0), {0.5, 0}, {0.6, 1}, {1.5, 1}, {1.6, 2}, {4.5, 4}, {4.6, 0}}) {
        film.filter.radius = radius;
        CAPTURE(radius);
        CHECK(filter_reach(film) == reach);
    }
}

TEST_CASE("Filters: around a crop pixels are sampled as far as the film goes") {
    Film film = film_of(FilterKind::gaussian);
    SampleWindow whole = sample_window(film);
    CHECK((whole.x == 0 && whole.y == 0 && whole.width == 30 && whole.height == 20));
    CHECK((whole.block_x == 0 && whole.blocks_x == 8 && whole.blocks_y == 5));
    CHECK((whole.reach == 2 && whole.tile_cells() == 64 && whole.pixel_stride == 30));

    film.crop_x = 9, film.crop_y = 1, film.crop_width = 10, film.crop_height = 19;
    SampleWindow crop = sample_window(film);
    CHECK((crop.x == 7 && crop.width == 14 && crop.y == 0 && crop.height == 20));
    CHECK((crop.block_x == 4 && crop.blocks_x == 5 && crop.block_y == 0));

    film.sample_border = true;
    SampleWindow border = sample_window(film);
    CHECK((border.x == 7 && border.width == 14 && border.y == -1 && border.height == 23));
    CHECK((border.block_y == -4 && border.blocks_y == 7 && border.pixel_stride == 34));

    film.filter.kind = FilterKind::box;
    SampleWindow box = sample_window(film);
    CHECK((box.x == 9 && box.width == 10 && box.block_x == 9 && box.blocks_x == 3));
    CHECK((box.reach == 0 && box.tile_cells() == BLOCK_PIXELS && box.pixel_stride == 30));
}
