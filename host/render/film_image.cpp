// From the device's film to an image.
#include "host/render/film_image.h"

#include "host/error.h"
#include "host/render/film_reader.h"

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
constexpr std::array film_aov_kinds{FILM_AOVS(AOV_INFO)};

/// Place of a kind in its list; the length of the list: there is no such kind.
template<std::size_t N>
int kind_of(const std::array<AovKindInfo, N>& kinds, const std::string& name) {
    auto found = std::find_if(kinds.begin(), kinds.end(),
                              [&](const AovKindInfo& kind) { return kind.name == name; });
    return static_cast<int>(found - kinds.begin());
}

std::string aov_kind_names() {
    std::string text;
    for (const AovKindInfo& kind : aov_kinds)
        text += fmt::format("{}, ", kind.name);
    for (const AovKindInfo& kind : film_aov_kinds)
        text += fmt::format("{}{}", kind.name, kind.name == film_aov_kinds.back().name ? "" : ", ");
    return text;
}

void check_twice(const std::vector<AovLayer>& layers, const AovRequest& request, int kind) {
    for (const AovLayer& layer : layers)
        if (layer.kind == kind || layer.name == request.name)
            throw InputError(fmt::format("{}: AOV '{}' ({}) is asked for twice",
                                         request.location.to_string(), request.name, request.kind));
}

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

bool is_film_aov(const AovRequest& request) {
    return kind_of(film_aov_kinds, request.kind) < film_aov_kind_count;
}

AovPlan plan_aovs(const Scene& scene) {
    AovPlan plan;
    for (const AovRequest& request : scene.integrator.aovs) {
        bool of_film = is_film_aov(request);
        int kind =
            of_film ? kind_of(film_aov_kinds, request.kind) : kind_of(aov_kinds, request.kind);
        if (!of_film && kind == aov_kind_count)
            throw InputError(fmt::format("{}: there is no AOV '{}'; there are {}",
                                         request.location.to_string(), request.kind,
                                         aov_kind_names()));
        check_twice(plan.layers, request, of_film ? -1 : kind);
        check_twice(plan.film_layers, request, of_film ? kind : -1);
        if (of_film && kind == film_aov_variance && scene.sampler.samples_per_pixel < 2)
            throw InputError(fmt::format("{}: AOV '{}' needs at least 2 samples per pixel",
                                         request.location.to_string(), request.kind));
        if (of_film) {
            plan.film_layers.push_back({request.name, kind, 0});
            continue;
        }
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
    for (const AovLayer& layer : aovs.film_layers) {
        const AovKindInfo& kind = film_aov_kinds[layer.kind];
        for (int c = 0; c < kind.channels; c++)
            add_channel(image, fmt::format("{}.{}", layer.name, kind.suffixes[c]),
                        layer.kind == film_aov_variance ? reader.variances(c)
                                                        : reader.sample_counts());
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
