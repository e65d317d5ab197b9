// The film plugin and the reconstruction filters.
#include "host/scene/limits.h"
#include "host/scene/mitsuba/leniency.h"
#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"

#include <fmt/format.h>

namespace parhelion::mitsuba {

namespace {

void read_crop(Properties& p, Film& film) {
    const bool any = p.has("crop_offset_x") || p.has("crop_offset_y") || p.has("crop_width") ||
                     p.has("crop_height");
    const auto read = [&](const char* name, int missing) {
        return static_cast<int>(p.integer(name, missing));
    };
    const int x = read("crop_offset_x", 0), y = read("crop_offset_y", 0);
    const int width = read("crop_width", film.width);
    const int height = read("crop_height", film.height);
    if (!any) return;
    p.check();
    if (x + width > film.width || y + height > film.height)
        refuse(p.location(), fmt::format("{}: the crop window {}x{} at ({}, {}) leaves the film of "
                                         "{}x{}",
                                         p.title(), width, height, x, y, film.width, film.height));
    film.crop_x = x;
    film.crop_y = y;
    film.crop_width = width;
    film.crop_height = height;
}

void read_formats(Properties& p, Film& film) {
    constexpr PixelFormat pixels[] = {PixelFormat::luminance, PixelFormat::luminance_alpha,
                                      PixelFormat::rgb,       PixelFormat::rgba,
                                      PixelFormat::xyz,       PixelFormat::xyza};
    const std::size_t chosen = p.choice("pixel_format", "rgb",
                                        {"luminance", "luminance_alpha", "rgb", "rgba", "xyz",
                                         "xyza", "luminancealpha"}); // the last is of 0.x
    film.pixel_format = chosen == 6 ? PixelFormat::luminance_alpha : pixels[chosen];
    constexpr ComponentFormat components[] = {ComponentFormat::float16, ComponentFormat::float32,
                                              ComponentFormat::uint32};
    film.component_format =
        components[p.choice("component_format", "float32", {"float16", "float32", "uint32"})];
}

/// What no film of ours writes: the command line says where an image goes and as what.
void note_file_format(Properties& p, std::initializer_list<std::string_view> accepted) {
    if (!p.has("file_format") || p.choice("file_format", *accepted.begin(), accepted) < 2) return;
    p.note("file_format", "\"file_format\" is not used: the name of --output chooses .exr or .png");
}

/// What all films have.
Film read_any_film(Properties& p) {
    Film film;
    film.width = static_cast<int>(p.integer("width", 768));
    film.height = static_cast<int>(p.integer("height", 576));
    p.check();
    if (std::int64_t(film.width) * film.height > most_film_pixels)
        p.refuse_value("width", fmt::format("{} with a height of {}", film.width, film.height),
                       fmt::format("{} pixels in all", most_film_pixels));
    read_crop(p, film);
    read_formats(p, film);
    film.sample_border = p.boolean("sample_border", false);
    film.sample_border =
        p.boolean("high_quality_edges", false) || film.sample_border; // its older name
    // Sums are exact enough, and a header is always written, whatever these say.
    p.boolean("compensate", false);
    p.boolean("banner", true);
    return film;
}

Film read_hdr_film(Properties& p) {
    note_file_format(p, {"openexr", "exr", "rgbe", "pfm"});
    // Of 0.x: whether the header holds what the program said.
    p.boolean("attach_log", true);
    return read_any_film(p);
}

/// Of Mitsuba 0.x, whose picture is that of hdrfilm, tone mapped.
Film read_ldr_film(Properties& p) {
    note_file_format(p, {"openexr", "exr", "png", "jpeg", "jpg"});
    p.choice("tonemap_method", "gamma", {"gamma", "reinhard"});
    for (const char* const name : {"gamma", "exposure", "key", "burn"})
        p.number(name, 0.0);
    p.note("", "film \"ldrfilm\" is read as \"hdrfilm\": the image is linear, and its tone mapping "
               "is left to viewers");
    return read_any_film(p);
}

/// Of Mitsuba 0.x, which writes numbers for other programs.
Film read_m_film(Properties& p) {
    note_file_format(p, {"openexr", "exr", "matlab", "mathematica", "numpy"});
    p.integer("digits", 4);
    p.text("variable", "data");
    p.note("", "film \"mfilm\" is read as \"hdrfilm\"");
    return read_any_film(p);
}

/// Of Mitsuba 0.x: for images that do not fit into its memory.
Film read_tiled_film(Properties& p) {
    p.note("", "film \"tiledhdrfilm\" is read as \"hdrfilm\"");
    return read_hdr_film(p);
}

using FilmReader = Film (*)(Properties&);
constexpr PluginTable<FilmReader, 4> film_plugins = {{{"hdrfilm", read_hdr_film},
                                                      {"ldrfilm", read_ldr_film},
                                                      {"mfilm", read_m_film},
                                                      {"tiledhdrfilm", read_tiled_film}}};

ReconstructionFilter read_box(Properties&) { return {.kind = FilterKind::box}; }

ReconstructionFilter read_tent(Properties& p) {
    return {.kind = FilterKind::tent, .radius = p.number("radius", 1.0)};
}

ReconstructionFilter read_gaussian(Properties& p) {
    return {.kind = FilterKind::gaussian, .stddev = p.number("stddev", 0.5)};
}

ReconstructionFilter read_mitchell(Properties& p) {
    return {.kind = FilterKind::mitchell,
            .mitchell_a = p.number("B", 1.0 / 3.0),
            .mitchell_b = p.number("C", 1.0 / 3.0)};
}

ReconstructionFilter read_catmull_rom(Properties&) { return {.kind = FilterKind::catmullrom}; }

ReconstructionFilter read_lanczos(Properties& p) {
    return {.kind = FilterKind::lanczos, .lanczos_lobes = static_cast<int>(p.integer("lobes", 3))};
}

using FilterReader = ReconstructionFilter (*)(Properties&);

constexpr PluginTable<FilterReader, 6> filter_plugins = {{{"box", read_box},
                                                          {"tent", read_tent},
                                                          {"gaussian", read_gaussian},
                                                          {"mitchell", read_mitchell},
                                                          {"catmullrom", read_catmull_rom},
                                                          {"lanczos", read_lanczos}}};

} // namespace

ReconstructionFilter read_filter(const Document& document, const Object& object, Notes& notes) {
    const auto kin = kin_outside(filter_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const FilterReader read = find_plugin(filter_plugins, known);
    const ReconstructionFilter filter = read(p);
    p.finish();
    return filter;
}

Film read_film(const Document& document, const Object& object, Notes& notes) {
    const auto kin = kin_outside(film_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const FilmReader read = find_plugin(film_plugins, known);
    Film film = read(p);
    const Object* const filter = p.only_child("rfilter");
    p.finish();
    if (filter) film.filter = read_filter(document, *filter, notes);
    return film;
}

} // namespace parhelion::mitsuba
