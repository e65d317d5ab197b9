// From the film's sums to an image.
#include "host/film/film_image.h"

#include "host/film/film_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace parhelion {
namespace {

/// Linear Rec. 709 to CIE XYZ (ITU-R BT.709 primaries, D65), rows X, Y, Z: the figures Mitsuba 3
/// uses.
constexpr double xyz_from_rgb[3][3] = {
    {0.412453, 0.357580, 0.180423}, {0.212671, 0.715160, 0.072169}, {0.019334, 0.119193, 0.950227}};

std::vector<float> combine(const std::array<std::vector<float>, 3>& rgb, const double (&row)[3]) {
    std::vector<float> out(rgb[0].size());
    for (std::size_t i = 0; i < out.size(); i++)
        out[i] = static_cast<float>(row[0] * rgb[0][i] + row[1] * rgb[1][i] + row[2] * rgb[2][i]);
    return out;
}

std::vector<float> scaled(std::vector<float> values, double factor) {
    for (float& v : values)
        v = static_cast<float>(v * factor);
    return values;
}

/// Coordinates in the scene. `shares`: of each pixel what is covered by them, since the centre is
/// only added there.
std::vector<float> in_scene(std::vector<float> coordinates, const std::vector<float>& shares,
                            double centre, double unit) {
    for (std::size_t i = 0; i < coordinates.size(); i++)
        coordinates[i] = static_cast<float>(coordinates[i] * unit + centre * shares[i]);
    return coordinates;
}

/// Radiance from `channel` of the film on. `unit`: what radiance 1 stands for; `layer`: what its
/// channels' names begin with.
void add_radiance(const FilmReader& film, int channel, PixelFormat format, double unit,
                  const std::string& layer, Image& image) {
    std::array<std::vector<float>, 3> rgb{scaled(film.means(channel), unit),
                                          scaled(film.means(channel + 1), unit),
                                          scaled(film.means(channel + 2), unit)};
    switch (format) {
    case PixelFormat::luminance:
    case PixelFormat::luminance_alpha:
        add_channel(image, layer + "Y", combine(rgb, xyz_from_rgb[1]));
        break;
    case PixelFormat::xyz:
    case PixelFormat::xyza:
        add_channel(image, layer + "X", combine(rgb, xyz_from_rgb[0]));
        add_channel(image, layer + "Y", combine(rgb, xyz_from_rgb[1]));
        add_channel(image, layer + "Z", combine(rgb, xyz_from_rgb[2]));
        break;
    case PixelFormat::rgb:
    case PixelFormat::rgba:
        add_channel(image, layer + "R", std::move(rgb[0]));
        add_channel(image, layer + "G", std::move(rgb[1]));
        add_channel(image, layer + "B", std::move(rgb[2]));
    }
}

void add_main_layer(const FilmReader& film, PixelFormat format, double unit, Image& image) {
    add_radiance(film, result_r, format, unit, "", image);
    if (format == PixelFormat::luminance_alpha || format == PixelFormat::rgba ||
        format == PixelFormat::xyza)
        add_channel(image, "A", film.means(result_alpha));
}

void add_aov_layer(const FilmReader& film, const AovLayer& layer, const SceneFrame& frame,
                   Image& image) {
    const AovKindInfo& kind = aov_kinds[layer.kind];
    auto means = [&](int channel) { return film.means(AOV_CHANNEL(layer.channel + channel)); };
    for (int c = 0; c < static_cast<int>(kind.suffixes.size()); c++) {
        std::vector<float> values = means(c);
        if (layer.kind == aov_depth) values = scaled(std::move(values), frame.unit());
        if (layer.kind == aov_position)
            values = in_scene(std::move(values), means(3), frame.centre()[c], frame.unit());
        add_channel(image, fmt::format("{}.{}", layer.name, kind.suffixes[c]), std::move(values));
    }
}

void add_film_layer(const FilmReader& film, const AovLayer& layer, const FilmContent& content,
                    Image& image) {
    const AovKindInfo& kind = film_aov_kinds[layer.kind];
    const int spread = content.spread_channel();
    const double unit = main_layer_unit(content.kind, content.frame);
    for (int c = 0; c < static_cast<int>(kind.suffixes.size()); c++)
        add_channel(image, fmt::format("{}.{}", layer.name, kind.suffixes[c]),
                    layer.kind == film_aov_variance ? scaled(film.variances(spread, c), unit * unit)
                                                    : film.sample_counts(spread));
}

} // namespace

double main_layer_unit(IntegratorKind kind, const SceneFrame& frame) {
    switch (kind) {
    case IntegratorKind::depth:
        return frame.unit();
    case IntegratorKind::normals:
        return 1.0;
    default:
        return frame.radiance_unit;
    }
}

Image film_image(const FilmSums& sums, const FilmContent& content, int first_row, int rows) {
    Image image;
    const Film& film = content.film;
    image.width = film.crop_width, image.height = rows;
    image.full_width = film.width, image.full_height = film.height;
    image.offset_x = film.crop_x, image.offset_y = film.crop_y + first_row;
    const FilmReader reader(sums, film.crop_width, first_row, rows);
    const double unit = main_layer_unit(content.kind, content.frame);
    add_main_layer(reader, film.pixel_format, unit, image);
    for (const AovLayer& layer : content.aovs.layers)
        add_aov_layer(reader, layer, content.frame, image);
    for (const LightGroupLayer& layer : content.aovs.light_groups)
        add_radiance(reader, AOV_CHANNEL(layer.channel), film.pixel_format, unit, layer.name + ".",
                     image);
    for (const AovLayer& layer : content.aovs.film_layers)
        add_film_layer(reader, layer, content, image);
    if (content.second_moment) {
        constexpr std::string_view suffixes = "RGB";
        for (int c = 0; c < 3; c++)
            add_channel(image, fmt::format("second_moment.{}", suffixes[c]),
                        scaled(reader.means(content.square_channel() + c), unit * unit));
    }
    add_cryptomatte(sums, content.cryptomatte, first_row, image);
    return image;
}

FilmPicture::FilmPicture(const FilmSums& sums, const FilmContent& content)
    : sums_(sums), content_(content), frame_(film_image(sums, content, 0, 0)) {
    frame_.height = content.film.crop_height;
    add_cryptomatte_header(content.cryptomatte, frame_);
}

} // namespace parhelion
