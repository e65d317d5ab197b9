// A film's sums on a disk, while it is rendered.
#include "host/film/film_store.h"

#include "host/parallel.h"

namespace parhelion {

/// Those of a row, from the digit `first` on.
struct FilmStore::Digits {
    std::uint64_t at;
    DigitRange range;
};

struct FilmStore::Weights {
    std::uint64_t at, count;
};

FilmStore::FilmStore(const std::string& folder, int width, int height, int channels)
    : file_(folder), width_(width), channels_(channels),
      digits_(static_cast<std::size_t>(height) * channels), weights_(height) {}

FilmStore::~FilmStore() = default;

void FilmStore::add_digits_of(const FilmSums& sums, int channel, int y, SumRow& row) {
    row.clear();
    sums.add_row(channel, y, row);
    const DigitRange range = digits_in_use(row);
    if (range.count == 0) return;
    const auto words = row.digits(range);
    digits_[static_cast<std::size_t>(y) * channels_ + channel].push_back(
        {file_.append(words.data(), words.size_bytes()), range});
}

void FilmStore::add_weights_of(const FilmSums& sums, int y) {
    ShapeWeights row;
    sums.add_coverage(y, row);
    if (row.empty()) return;
    add_up(row);
    weights_[y].push_back({file_.append(row.data(), row.size() * sizeof row[0]), row.size()});
}

void FilmStore::add(const FilmSums& sums, int first, int end) {
    parallel_for(static_cast<std::size_t>(end - first), [&](std::size_t n) {
        const int y = first + static_cast<int>(n);
        SumRow row(width_);
        for (int channel = 0; channel < channels_; channel++)
            add_digits_of(sums, channel, y, row);
        add_weights_of(sums, y);
    });
}

void FilmStore::add_row(int channel, int y, SumRow& row) const {
    const auto& all = digits_[static_cast<std::size_t>(y) * channels_ + channel];
    if (all.empty()) return;
    for (const Digits& digits : all) {
        SumRow read(width_);
        const auto words = read.digits(digits.range);
        file_.read(digits.at, words.data(), words.size_bytes());
        add_digits(row, 0, row.width(), [&](int k) { return read.digit(k).data(); });
    }
}

void FilmStore::add_coverage(int y, ShapeWeights& row) const {
    for (const Weights& weights : weights_[y]) {
        const std::size_t before = row.size();
        row.resize(before + weights.count);
        file_.read(weights.at, &row[before], weights.count * sizeof row[0]);
    }
}

std::uint64_t usual_store_bytes(const FilmLayout& layout, const Film& crop, int samples) {
    const std::uint64_t digits = has_negative_values(crop.filter.kind) ? EXACT_WORDS : 3;
    const std::uint64_t passes = samples > FILM_SAMPLES && samples % FILM_SAMPLES != 0 ? 2 : 1;
    return passes * digits * sizeof(std::uint32_t) * layout.channels() *
           static_cast<std::uint64_t>(crop.crop_width) * crop.crop_height;
}

} // namespace parhelion
