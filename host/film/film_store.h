// A film's sums on a disk, while it is rendered: those of bands that are not in memory.
#pragma once

#include "host/film/film_layout.h"
#include "host/film/film_sums.h"
#include "host/scratch_file.h"

#include <string>
#include <vector>

namespace parhelion {

/// What was added to it, row by row and without error; rows that were added to several times are
/// summed up where they are read.
class FilmStore : public FilmSums {
public:
    /// Of nothing, in a file without a name in `folder`. Throws OutputError.
    FilmStore(const std::string& folder, int width, int height, int channels);
    ~FilmStore() override;

    /// Adds rows [first, end) of a film of that size. Throws OutputError where the disk is full.
    void add(const FilmSums& sums, int first, int end);

    void add_row(int channel, int y, SumRow& row) const override;
    void add_coverage(int y, ShapeWeights& row) const override;

    std::uint64_t bytes() const { return file_.bytes(); }

private:
    struct Digits;
    struct Weights;
    void add_digits_of(const FilmSums& sums, int channel, int y, SumRow& row);
    void add_weights_of(const FilmSums& sums, int y);

    ScratchFile file_;
    int width_, channels_;
    std::vector<std::vector<Digits>> digits_;   ///< by pixel row and channel
    std::vector<std::vector<Weights>> weights_; ///< by pixel row
};

/// What a store of a film of so many samples a pixel usually takes, bytes: three digits of each
/// sum, of a filter that has negative values all of them (a row is kept in the digits that some
/// pixel of it needs); twice where whole groups of samples and others are added one after the
/// other.
std::uint64_t usual_store_bytes(const FilmLayout& layout, const Film& crop, int samples);

} // namespace parhelion
