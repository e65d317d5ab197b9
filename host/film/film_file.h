// Films in files: what a checkpoint and a part of a render are kept as.
//
// A file begins with what it is of (FilmHeader); then come the rows of pixels, from the top, of
// each the sums of its channels without error, leaving out digits that are 0 in all of the row.
// Films whose samples are others of one render add up to that of the render, to the bit, in any
// order.
#pragma once

#include "host/film/film_content.h"
#include "host/film/film_state.h"
#include "host/film/film_sums.h"
#include "host/film/render_key.h"
#include "host/image/image.h"
#include "host/image/output.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parhelion {

struct FilmHeader {
    RenderKey key;
    FilmContent content;
    int blocks = 0; ///< of the sampled window
    int samples_per_pixel = 0;
    std::string part_name; ///< "3/8 by blocks"; nothing for the whole
    SampleSet part;        ///< the samples that it is of when it is finished
    FilmState state;
    /// Of the picture.
    std::vector<std::pair<std::string, MetadataValue>> metadata;

    /// The samples of the whole render.
    SampleSet all() const { return all_samples(blocks, samples_per_pixel); }
};

/// The file appears whole or not at all, as PendingFile says. Throws OutputError.
void write_film(const std::string& file, const FilmHeader& header, const FilmSums& sums,
                Existing existing);

/// What such a file holds, to be written later.
std::string film_bytes(const FilmHeader& header, const FilmSums& sums);

/// The most that such a file can have, in bytes, when all samples of `header` are on the film: of
/// every sum all digits, and of a Cryptomatte as many shapes in every pixel as there may be.
std::uint64_t most_film_bytes(const FilmHeader& header);

/// Whether a file begins as a film does, whatever it is called. Pipes are not looked into: false.
bool begins_as_film(const std::string& file);

/// A film in a file; rows are read from there when they are asked for.
class FilmFile : public FilmSums {
public:
    /// Throws InputError, in one line, for what is no film, is damaged or not whole.
    explicit FilmFile(const std::string& file);
    ~FilmFile() override;

    const std::string& name() const { return name_; }
    const FilmHeader& header() const { return header_; }
    /// Of the file.
    std::uint64_t bytes() const { return size_; }
    /// Throws InputError for a row that is damaged.
    void add_row(int channel, int y, SumRow& row) const override;
    void add_coverage(int y, ShapeWeights& row) const override;

private:
    struct Row;
    struct CoverageRow;
    void read(std::uint64_t at, void* bytes, std::size_t count) const;
    void read_header();
    void find_rows();

    std::string name_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0, rows_begin_ = 0;
    FilmHeader header_;
    void find_coverage(std::uint32_t y, std::uint64_t checksum, std::uint64_t& at);

    std::vector<Row> rows_; ///< by pixel row and channel
    std::vector<CoverageRow> coverage_rows_;
};

/// The sums of several films of one size.
class AddedFilms : public FilmSums {
public:
    /// They must outlive it.
    explicit AddedFilms(std::vector<const FilmSums*> films) : films_(std::move(films)) {}

    void add_row(int channel, int y, SumRow& row) const override {
        for (const FilmSums* film : films_)
            film->add_row(channel, y, row);
    }
    void add_coverage(int y, ShapeWeights& row) const override {
        for (const FilmSums* film : films_)
            film->add_coverage(y, row);
    }

private:
    std::vector<const FilmSums*> films_;
};

} // namespace parhelion
