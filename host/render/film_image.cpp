// From the device's film to an image.
#include "host/render/film_image.h"

#include "host/error.h"

#include <fmt/format.h>

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

/// Reads one film channel as means: (sum + rounding error) / weight, or the plain sum.
class FilmReader {
public:
    FilmReader(const std::vector<float>& film, const WorkSizes& sizes, const Film& crop)
        : film_(film), sizes_(sizes), crop_(crop) {}

    std::vector<float> means(int channel) const {
        std::vector<float> out;
        out.reserve(static_cast<std::size_t>(crop_.crop_width) * crop_.crop_height);
        for (int y = 0; y < crop_.crop_height; y++)
            for (int x = 0; x < crop_.crop_width; x++) {
                double weight = sum(result_weight, x, y);
                // No sample, or filter weights that cancel exactly: there is no mean, and black
                // would be a lie only there.
                out.push_back(
                    static_cast<float>(weight != 0.0 ? sum(channel, x, y) / weight : 0.0));
            }
        return out;
    }

private:
    double sum(int channel, int x, int y) const {
        std::size_t block = static_cast<std::size_t>(y / 4) * sizes_.blocks_x + x / 4;
        std::size_t at = channel * sizes_.film_stride() + block * BLOCK_PIXELS + y % 4 * 4 + x % 4;
        return double{film_[at]} + film_[at + sizes_.film_channels * sizes_.film_stride()];
    }

    const std::vector<float>& film_;
    const WorkSizes& sizes_;
    const Film& crop_;
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
