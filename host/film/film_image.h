// From the film's sums to an image.
#pragma once

#include "host/film/film_content.h"
#include "host/film/film_sums.h"
#include "host/image/image_rows.h"

namespace parhelion {

/// What 1 on the device stands for in the main layer of an image: a radiance, a length, or a part
/// of a normal.
double main_layer_unit(IntegratorKind kind, const SceneFrame& frame);

/// Divides the sums by the filter weights, turns what the device has in units of its own into the
/// scene's, and names the channels: of so many rows of the crop.
Image film_image(const FilmSums& sums, const FilmContent& content, int first_row, int rows);
inline Image film_image(const FilmSums& sums, const FilmContent& content) {
    return film_image(sums, content, 0, content.film.crop_height);
}

/// The picture of a film, made where it is asked for.
class FilmPicture : public ImageRows {
public:
    /// Both must outlive it.
    FilmPicture(const FilmSums& sums, const FilmContent& content);

    const Image& frame() const override { return frame_; }
    /// To put metadata in.
    Image& frame() { return frame_; }
    Image rows(int first, int count) const override {
        return film_image(sums_, content_, first, count);
    }

private:
    const FilmSums& sums_;
    const FilmContent& content_;
    Image frame_;
};

} // namespace parhelion
