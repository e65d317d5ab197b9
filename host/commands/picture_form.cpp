// How the picture of a film is written as an .exr, as `render` and `merge` are asked to.
#include "host/commands/picture_form.h"

#include "host/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace parhelion {
namespace {

constexpr const char* every_layer = "all";
constexpr std::array component_names{std::pair{"half", ComponentFormat::float16},
                                     std::pair{"float", ComponentFormat::float32}};

struct LayerFormat {
    std::string layer;
    ComponentFormat component;
};

LayerFormat layer_format(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals != std::string::npos && equals > 0)
        for (const auto& [name, component] : component_names)
            if (text.substr(equals + 1) == name) return {text.substr(0, equals), component};
    throw InputError(fmt::format("--layer-format '{}': expected NAME=half or NAME=float", text));
}

ExrCompression compression_of(const PictureForm& form) {
    if (!form.compression) return ExrCompression::zip;
    const auto* found =
        std::find(exr_compression_names.begin(), exr_compression_names.end(), *form.compression);
    if (found == exr_compression_names.end())
        throw InputError(fmt::format("--exr-compression '{}': there are {}", *form.compression,
                                     fmt::join(exr_compression_names, ", ")));
    return static_cast<ExrCompression>(found - exr_compression_names.begin());
}

/// `whole_numbers` that half does not hold beyond 2048; `hashes` that only float holds.
enum class Values { any, whole_numbers, hashes };

struct PictureLayer {
    std::string name;
    Values values;
};

template<class Kind>
Values values_of(const Kind& kind) {
    return holds_whole_numbers(kind) ? Values::whole_numbers : Values::any;
}

std::vector<PictureLayer> layers_of(const FilmContent& content) {
    std::vector<PictureLayer> layers{{"", Values::any}};
    for (const AovLayer& layer : content.aovs.layers)
        layers.push_back({layer.name, values_of(aov_kinds[layer.kind])});
    for (const AovLayer& layer : content.aovs.film_layers)
        layers.push_back({layer.name, values_of(film_aov_kinds[layer.kind])});
    for (const LightGroupLayer& layer : content.aovs.light_groups)
        layers.push_back({layer.name, Values::any});
    if (content.second_moment) layers.push_back({"second_moment", Values::any});
    for (const CryptomatteLayer& layer : content.cryptomatte.layers)
        for (const std::string& name : channel_layers(layer, content.cryptomatte.depth))
            layers.push_back({name, Values::hashes});
    return layers;
}

const PictureLayer& layer_called(const std::string& name, const std::vector<PictureLayer>& layers) {
    std::vector<std::string> names;
    for (const PictureLayer& layer : layers) {
        names.push_back(layer.name.empty() ? main_layer_name : layer.name);
        if (names.back() == name) return layer;
    }
    throw InputError(fmt::format("--layer-format: the picture has no layer '{}'; there are {}, and "
                                 "{} for every one",
                                 name, fmt::join(names, ", "), every_layer));
}

/// What is said of all, then of each.
void set_components(const PictureForm& form, const std::vector<PictureLayer>& layers,
                    ExrOptions& options) {
    std::set<std::string> named;
    for (const std::string& text : form.layer_formats) {
        const LayerFormat format = layer_format(text);
        if (!named.insert(format.layer).second)
            throw InputError(
                fmt::format("--layer-format: '{}' is named more than once", format.layer));
        if (format.layer == every_layer) {
            options.component = format.component;
            continue;
        }
        const PictureLayer& layer = layer_called(format.layer, layers);
        if (layer.values != Values::any && format.component == ComponentFormat::float16)
            throw InputError(fmt::format(
                "--layer-format '{}': half does not hold the {} of that layer (accepted: float)",
                text, layer.values == Values::hashes ? "names" : "whole numbers beyond 2048"));
        options.layers[layer.name] = format.component;
    }
}

} // namespace

bool is_film_file(const std::string& file) {
    return std::filesystem::path(file).extension() == ".film";
}

std::vector<Option> picture_form_options(PictureForm& form) {
    return {
        {"--exr-compression",
         &form.compression,
         "How an .exr is packed: none, rle, zips, zip (the default) and piz lose nothing. Lossy "
         "are pxr24 (rounds float to 24 bits), b44 and b44a (of half), dwaa and dwab (of channels "
         "R, G, B and Y)",
         {.words = {exr_compression_names.begin(), exr_compression_names.end()}}},
        {"--layer-format", &form.layer_formats,
         "NAME=half or NAME=float: the component of a layer of an .exr (repeat for more); the main "
         "one is called image, all of them all. Counts and indices stay float by themselves"},
    };
}

void check_picture_form(const PictureForm& form, const std::string& output) {
    compression_of(form);
    for (const std::string& text : form.layer_formats)
        layer_format(text);
    if (!form.asked()) return;
    const char* const option = form.compression ? "--exr-compression" : "--layer-format";
    if (is_film_file(output))
        throw InputError(fmt::format("{}: is for the picture that `parhelion merge` makes of "
                                     "films; give it to that",
                                     option));
    if (image_format(output) == ImageFormat::png)
        throw InputError(fmt::format("{}: is for .exr files", option));
}

ExrOptions exr_options(const PictureForm& form, const FilmContent& content) {
    ExrOptions options;
    options.component = content.film.component_format;
    options.compression = compression_of(form);
    const std::vector<PictureLayer> layers = layers_of(content);
    set_components(form, layers, options);
    for (const PictureLayer& layer : layers) {
        if (layer.values == Values::any) continue;
        if (options.component == ComponentFormat::float16 || layer.values == Values::hashes)
            options.layers[layer.name] = ComponentFormat::float32;
        const ExrLoss loss = exr_losses[static_cast<std::size_t>(options.compression)];
        if (loss == ExrLoss::of_floats ||
            (loss == ExrLoss::of_colors && layer.values == Values::hashes))
            throw InputError(fmt::format("--exr-compression {}: changes the {} of layer '{}' "
                                         "(accepted: one that keeps them, e.g. zip, piz)",
                                         *form.compression,
                                         layer.values == Values::hashes ? "names" : "whole numbers",
                                         layer.name));
    }
    return options;
}

WriteOptions write_options(const PictureForm& form, const FilmContent& content,
                           std::optional<double> exposure, Existing existing) {
    WriteOptions options{exposure.value_or(0.0), exr_options(form, content)};
    options.exr.existing = existing;
    return options;
}

} // namespace parhelion
