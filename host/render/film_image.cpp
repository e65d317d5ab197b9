// From the device's film to an image.
#include "host/render/film_image.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace parhelion {
namespace {

struct AovKindInfo {
    std::string_view name;
    int channels;
    std::string_view suffixes;
};
#define AOV_INFO(name, channels, suffixes) AovKindInfo{#name, channels, suffixes},
constexpr std::array aov_kinds{AOVS(AOV_INFO)};
static_assert(aov_kinds.size() <= AOV_LIMIT);

std::string aov_kind_names() {
    std::string text;
    for (const AovKindInfo& kind : aov_kinds)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", kind.name);
    return text;
}

/// The range of tiles along one axis that hold a pixel, counted from the first block's corner.
struct TileRange {
    int first, last;

    TileRange(int pixel, int reach, int blocks)
        : first(std::max(0, (pixel - reach) / 4)), last(std::min(blocks - 1, (pixel + reach) / 4)) {
    }
};

/// Reads the film's channels as means: sum / weight, each over all tiles that hold the pixel.
class FilmReader {
public:
    FilmReader(const std::vector<float>& film, const WorkSizes& sizes, const Film& crop)
        : film_(film), sizes_(sizes), crop_(crop), weights_(sums(result_weight)) {}

    std::vector<float> means(int channel) const {
        std::vector<double> values = sums(channel);
        std::vector<float> out(values.size());
        // No sample, or filter weights that cancel exactly: there is no mean, and black would be a
        // lie only there.
        for (std::size_t i = 0; i < out.size(); i++)
            if (weights_[i] != 0.0) out[i] = static_cast<float>(values[i] / weights_[i]);
        return out;
    }

private:
    std::vector<double> sums(int channel) const {
        std::vector<double> out;
        out.reserve(static_cast<std::size_t>(crop_.crop_width) * crop_.crop_height);
        for (int y = 0; y < crop_.crop_height; y++)
            for (int x = 0; x < crop_.crop_width; x++)
                out.push_back(sum(channel, x + crop_.crop_x, y + crop_.crop_y));
        return out;
    }

    /// In the order of the tiles, with the rounding errors of the device's sums.
    double sum(int channel, int x, int y) const {
        const SampleWindow& window = sizes_.window;
        int from_x = x - window.block_x, from_y = y - window.block_y,
            side = TILE_SIDE(window.reach);
        TileRange columns(from_x, window.reach, window.blocks_x);
        TileRange rows(from_y, window.reach, window.blocks_y);
        std::size_t errors = sizes_.film_channels * sizes_.film_stride();
        double total = 0.0;
        for (int row = rows.first; row <= rows.last; row++)
            for (int column = columns.first; column <= columns.last; column++) {
                std::size_t tile = static_cast<std::size_t>(row) * window.blocks_x + column;
                int cell =
                    (from_y - 4 * row + window.reach) * side + from_x - 4 * column + window.reach;
                std::size_t at = channel * sizes_.film_stride() + tile * window.tile_cells() + cell;
                total += double{film_[at]} + film_[at + errors];
            }
        return total;
    }

    const std::vector<float>& film_;
    const WorkSizes& sizes_;
    const Film& crop_;
    std::vector<double> weights_;
};

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

void add_main_layer(const FilmReader& film, PixelFormat format, Image& image) {
    std::array<std::vector<float>, 3> rgb{film.means(result_r), film.means(result_g),
                                          film.means(result_b)};
    switch (format) {
    case PixelFormat::luminance:
    case PixelFormat::luminance_alpha:
        add_channel(image, "Y", combine(rgb, xyz_from_rgb[1]));
        break;
    case PixelFormat::xyz:
    case PixelFormat::xyza:
        add_channel(image, "X", combine(rgb, xyz_from_rgb[0]));
        add_channel(image, "Y", combine(rgb, xyz_from_rgb[1]));
        add_channel(image, "Z", combine(rgb, xyz_from_rgb[2]));
        break;
    case PixelFormat::rgb:
    case PixelFormat::rgba:
        add_channel(image, "R", std::move(rgb[0]));
        add_channel(image, "G", std::move(rgb[1]));
        add_channel(image, "B", std::move(rgb[2]));
    }
    if (format == PixelFormat::luminance_alpha || format == PixelFormat::rgba ||
        format == PixelFormat::xyza)
        add_channel(image, "A", film.means(result_alpha));
}

} // namespace

AovPlan plan_aovs(const Integrator& integrator) {
    AovPlan plan;
    for (const AovRequest& request : integrator.aovs) {
        int kind = 0;
        while (kind < static_cast<int>(aov_kinds.size()) && aov_kinds[kind].name != request.kind)
            kind++;
        if (kind == static_cast<int>(aov_kinds.size()))
            throw InputError(fmt::format("{}: there is no AOV '{}'; there are {}",
                                         request.location.to_string(), request.kind,
                                         aov_kind_names()));
        for (const AovLayer& layer : plan.layers)
            if (layer.kind == kind || layer.name == request.name)
                throw InputError(fmt::format("{}: AOV '{}' ({}) is asked for twice",
                                             request.location.to_string(), request.name,
                                             request.kind));
        plan.layers.push_back({request.name, kind, plan.channels});
        plan.channels += aov_kinds[kind].channels;
    }
    return plan;
}

Image film_image(const std::vector<float>& film, const WorkSizes& sizes, const Scene& scene,
                 const AovPlan& aovs) {
    const Film& crop = scene.film;
    Image image;
    image.width = crop.crop_width, image.height = crop.crop_height;
    image.full_width = crop.width, image.full_height = crop.height;
    image.offset_x = crop.crop_x, image.offset_y = crop.crop_y;
    FilmReader reader(film, sizes, crop);
    add_main_layer(reader, crop.pixel_format, image);
    for (const AovLayer& layer : aovs.layers) {
        const AovKindInfo& kind = aov_kinds[layer.kind];
        for (int c = 0; c < kind.channels; c++)
            add_channel(image, fmt::format("{}.{}", layer.name, kind.suffixes[c]),
                        reader.means(result_field_count + layer.channel + c));
    }
    if (scene.integrator.second_moment) {
        constexpr std::string_view suffixes = "RGB";
        for (int c = 0; c < 3; c++)
            add_channel(image, fmt::format("second_moment.{}", suffixes[c]),
                        reader.means(result_field_count + aovs.channels + c));
    }
    return image;
}

} // namespace parhelion
