// A small film whose sums are known.
#pragma once

#include "host/film/exact_value.h"
#include "host/film/film_sums.h"
#include "host/numerics/exact_sum.h"
#include "host/numerics/measure.h"

#include <array>
#include <cstdint>
#include <vector>

namespace parhelion::test {

inline constexpr int width = 5, height = 3, channels = 5;

/// Sums of doubles that floats hold; each kept as the film does.
class KnownFilm : public FilmSums {
public:
    explicit KnownFilm(unsigned seed) {
        numerics::Random random(seed);
        for (auto& of_pixel : digits_) {
            if (random.bits() % 3 == 0) continue; // nothing there
            numerics::ExactSum sum;
            for (int k = 0; k < 5; k++)
                sum.add(static_cast<float>(random.sign() * random.log_between(1e-30, 1e30)));
            of_pixel = sum.digits();
        }
    }

    void add_row(int channel, int y, SumRow& row) const override {
        SumRow own(width);
        for (int x = 0; x < width; x++)
            for (int k = 0; k < EXACT_WORDS; k++)
                own.digit(k)[x] = digits_[(channel * height + y) * width + x][k];
        add_digits(row, 0, width, [&](int k) { return own.digit(k).data(); });
    }

private:
    std::vector<std::array<std::uint32_t, EXACT_WORDS>> digits_{width * height * channels};
};

inline double value(const FilmSums& film, int channel, int y, int x) {
    SumRow row(width);
    film.add_row(channel, y, row);
    return exact_value(&row.digit(0)[x], row.width()).high;
}

} // namespace parhelion::test
