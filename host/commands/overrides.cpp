// Command-line values that replace the scene's.
#include "host/commands/light_group_options.h"
#include "host/commands/render.h"
#include "host/flatten/filter_table.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace parhelion {
namespace {

#define NAMED_INTEGRATOR(name) std::pair{std::string_view(#name), IntegratorKind::name},
constexpr std::array integrators{INTEGRATORS(NAMED_INTEGRATOR)};

#define NAMED_PATTERN(name) std::pair{std::string_view(#name), SamplePattern::name},
constexpr std::array patterns{SAMPLE_PATTERNS(NAMED_PATTERN)};

#define NAMED_METHOD(name) std::pair{std::string_view(#name), FilterMethod::name},
constexpr std::array filter_methods{FILTER_METHODS(NAMED_METHOD)};

#define NAMED_NORMALS(name) std::pair{std::string_view(#name), ShadingNormals::name},
constexpr std::array shading_normals{SHADING_NORMALS(NAMED_NORMALS)};

/// Integers separated by `separator`; fewer or more than N, or anything else, is an error that
/// shows the form.
template<std::size_t N>
std::array<int, N> parse_integers(std::string_view option, std::string_view text, char separator,
                                  std::string_view form) {
    std::array<int, N> values{};
    const char *at = text.data(), *stop = at + text.size();
    for (std::size_t i = 0; i < N; i++) {
        auto [end, error] = std::from_chars(at, stop, values[i]);
        bool last = i + 1 == N;
        if (error != std::errc{} || last != (end == stop) || (!last && *end != separator))
            throw InputError(fmt::format("{} '{}': expected {}", option, text, form));
        at = last ? end : end + 1;
    }
    return values;
}

void set_size(const std::string& text, Film& film) {
    auto [width, height] =
        parse_integers<2>("--size", text, 'x', "WIDTHxHEIGHT in pixels, e.g. 640x480");
    if (!placed(film_side_domain, width) || !placed(film_side_domain, height) ||
        std::int64_t{width} * height > most_film_pixels)
        throw InputError(fmt::format("--size '{}': each side is {}, and both make {} at most", text,
                                     accepted_text(film_side_domain), most_film_pixels));
    film.width = width, film.height = height;
    film.crop_x = film.crop_y = film.crop_width = film.crop_height = 0;
}

void set_crop(const std::string& text, Film& film) {
    auto [x, y, width, height] =
        parse_integers<4>("--crop", text, ',', "X,Y,WIDTH,HEIGHT in pixels, e.g. 0,0,64,64");
    bool inside = x >= 0 && y >= 0 && width >= 1 && height >= 1 && x <= film.width - width &&
                  y <= film.height - height;
    if (!inside)
        throw InputError(fmt::format("--crop '{}': must lie inside the film of {}x{} pixels", text,
                                     film.width, film.height));
    film.crop_x = x, film.crop_y = y, film.crop_width = width, film.crop_height = height;
}

/// The value that `table` has for the name; throws InputError that lists the names there are.
template<class Value, std::size_t N>
Value named(std::string_view option, const std::string& name,
            const std::array<std::pair<std::string_view, Value>, N>& table) {
    std::string names;
    for (const auto& [known, value] : table) {
        if (known == name) return value;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", known);
    }
    throw InputError(fmt::format("{} '{}': there are {}", option, name, names));
}

AovRequest aov_request(const std::string& name) {
    // "normals" is what everyone calls the shading normals.
    return {name, name == "normals" ? "sh_normal" : name, {"--aov", 0}};
}

void set_cryptomatte(const RenderCommand& command, CryptomatteRequest& request) {
    for (const std::string& name : command.cryptomatte) {
        if (name != cryptomatte_names[0] && name != cryptomatte_names[1])
            throw InputError(fmt::format("--cryptomatte '{}': there are {}", name,
                                         fmt::join(cryptomatte_names, ", ")));
        bool& asked = name == cryptomatte_names[0] ? request.objects : request.materials;
        if (asked) throw InputError(fmt::format("--cryptomatte '{}': is asked for twice", name));
        asked = true;
    }
    if (command.cryptomatte_depth) request.depth = *command.cryptomatte_depth;
}

void check_replicates(const Sampler& sampler) {
    if (sampler.replicates > 1 && sampler.pattern == SamplePattern::independent)
        throw InputError(fmt::format(
            "--replicates {}: independent samples have no pattern (accepted: --sampler faure)",
            sampler.replicates));
    if (sampler.replicates > sampler.samples_per_pixel)
        throw InputError(fmt::format(
            "--replicates {}: a pixel has {} (accepted: a number up to that)", sampler.replicates,
            sampler.samples_per_pixel == 1 ? "1 sample"
                                           : fmt::format("{} samples", sampler.samples_per_pixel)));
}

bool is_cropped(const Film& film) {
    return film.crop_width > 0 && (film.crop_width < film.width || film.crop_height < film.height);
}

std::string lost_crop_note(const Film& film) {
    return fmt::format(
        "--size: the scene's crop of {}x{} pixels at {},{} is of a film of {}x{} and "
        "does not count (--crop gives one)",
        film.crop_width, film.crop_height, film.crop_x, film.crop_y, film.width, film.height);
}

} // namespace

std::vector<UsedFile> files_of(const Scene& scene) {
    std::vector<UsedFile> files{{"the scene", scene.file}};
    for (const std::string& file : scene.files)
        files.push_back({"a file of the scene,", file});
    return files;
}

void leave_out_energy_compensation(Scene& scene) {
    auto leave_out = [](auto& b) {
        if constexpr (requires { b.energy_compensation; }) b.energy_compensation = false;
    };
    for (Material& material : scene.materials)
        std::visit(leave_out, material.bsdf);
}

LoadOptions load_options(const RenderCommand& command) {
    return {.parameters = parse_definitions(command.definitions),
            .allow_outside = command.allow_outside,
            .sensor = command.sensor,
            .own_integrator = command.integrator.has_value(),
            .lenient = command.lenient};
}

void apply_overrides(const RenderCommand& command, Scene& scene) {
    if (command.size && !command.crop && is_cropped(scene.film))
        scene.notes.push_back(lost_crop_note(scene.film));
    if (command.size) set_size(*command.size, scene.film);
    if (command.crop) set_crop(*command.crop, scene.film);
    Film& film = scene.film;
    if (film.crop_width == 0)
        film.crop_x = film.crop_y = 0, film.crop_width = film.width, film.crop_height = film.height;
    if (command.integrator)
        scene.integrator.kind = named("--integrator", *command.integrator, integrators);
    if (command.sampler) scene.sampler.pattern = named("--sampler", *command.sampler, patterns);
    if (command.filter_method)
        film.filter_method = named("--filter-by", *command.filter_method, filter_methods);
    if (command.replicates) scene.sampler.replicates = *command.replicates;
    if (command.samples) scene.sampler.samples_per_pixel = *command.samples;
    check_replicates(scene.sampler);
    if (command.max_depth) scene.integrator.max_depth = *command.max_depth;
    if (command.rr_depth) scene.integrator.rr_depth = *command.rr_depth;
    if (command.seed) scene.sampler.seed = *command.seed;
    if (!command.next_event) scene.integrator.emitter_samples = false;
    if (command.shading_normals)
        scene.integrator.shading_normals =
            named("--shading-normals", *command.shading_normals, shading_normals);
    if (!command.energy_compensation) leave_out_energy_compensation(scene);
    for (const std::string& name : command.aovs)
        scene.integrator.aovs.push_back(aov_request(name));
    set_cryptomatte(command, scene.integrator.cryptomatte);
    if (!command.light_groups.empty() || command.group_by_light)
        scene.integrator.light_groups =
            light_groups(command.light_groups, command.group_by_light, scene);
}

std::array<int, 2> parse_pixel(const std::string& text, const Film& film) {
    std::array<int, 2> pixel = parse_integers<2>("--pixel", text, ',', "X,Y, e.g. 12,34");
    int border = film.sample_border ? filter_reach(film) : 0;
    if (pixel[0] < -border || pixel[1] < -border || pixel[0] >= film.width + border ||
        pixel[1] >= film.height + border)
        throw InputError(fmt::format("--pixel '{}': must lie inside the film of {}x{} pixels{}",
                                     text, film.width, film.height,
                                     border ? fmt::format(" and its border of {}", border) : ""));
    return pixel;
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions) {
    std::map<std::string, std::string> parameters;
    for (const std::string& definition : definitions) {
        std::size_t equals = definition.find('=');
        if (equals == std::string::npos || equals == 0)
            throw InputError(fmt::format("-D '{}': expected name=value", definition));
        parameters[definition.substr(0, equals)] = definition.substr(equals + 1);
    }
    return parameters;
}

} // namespace parhelion
