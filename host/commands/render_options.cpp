// The options of `parhelion render`, and what they cannot be whatever the scene.
#include "host/commands/message_options.h"
#include "host/commands/option_number.h"
#include "host/commands/render.h"
#include "host/commands/render_domains.h"
#include "host/error.h"
#include "host/image/output.h"
#include "kernels/shared/features.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

namespace parhelion {
namespace {

void append(std::vector<Option>& options, const std::vector<Option>& more) {
    options.insert(options.end(), more.begin(), more.end());
}

std::vector<std::string> words_of(const auto& names) { return {names.begin(), names.end()}; }

/// "normals" is what everyone calls the shading normals.
std::vector<std::string> aov_words() {
#define AOV_WORD(name, ...) #name,
    return {"normals", AOVS(AOV_WORD) FILM_AOVS(AOV_WORD)};
#undef AOV_WORD
}

std::vector<Option> of_samples(std::vector<Option> options) {
    for (Option& option : options)
        option.rules.of_samples = true;
    return options;
}

std::vector<Option> sampling_options(RenderCommand& c) {
    return of_samples({
        {"--spp", &c.samples, "Samples per pixel", {.domain = samples_per_pixel_domain}},
        {"--size", &c.size, "Film size, WIDTHxHEIGHT", {.domain = film_side_domain}},
        {"--seed", &c.seed, "Seed of the random numbers", {.domain = seed_domain}},
    });
}

std::vector<Option> image_options(RenderCommand& c) {
    return {
        {"scene",
         &c.scenes,
         "Scene file (Mitsuba 3 XML), or several",
         {.required = true, .kind = ValueKind::file}},
        {"-o,--output", &c.output, "Image to write, .exr or .png", {.kind = ValueKind::file}},
        {"--crop",
         &c.crop,
         "Part of the film, X,Y,WIDTH,HEIGHT",
         {.of_film = true, .domain = crop_domain}},
        {"--exposure", &c.exposure, "Stops of exposure for .png", {.domain = exposure_domain}},
        {"--stats",
         &c.stats_file,
         "Write times, counts and memory as JSON",
         {.kind = ValueKind::file}},
        log_option(c.log_file),
        {"--force", &c.force, "Overwrite files that exist"},
        {"--strict", &c.strict,
         "Exit code 1 if a sample was not finite, or a value of the image is not or does not fit "
         "the "
         "file's format; the image is written all the same"},
        {"--precision",
         &c.precision,
         "single, on the device (the default); double, the same kernels on the host: slow, to see "
         "what rounding does",
         {.of_film = true, .words = words_of(precision_names)}},
        {"--threads", &c.threads, "CPU threads, 0 for all", {.domain = threads_domain}},
    };
}

std::vector<Option> light_options(RenderCommand& c) {
    return of_samples({
        {"--integrator", &c.integrator, integrator_help, {.words = words_of(integrator_names)}},
        {"--sensor", &c.sensor, sensor_help, {.domain = sensor_domain}},
        {"--max-depth",
         &c.max_depth,
         "Longest path in edges: 1 emitters only, 2 direct light, -1 no limit",
         {.domain = max_depth_domain}},
        {"--rr-depth",
         &c.rr_depth,
         "Russian roulette from this many vertices on",
         {.domain = rr_depth_domain}},
        {"!--no-next-event", &c.next_event, "Do not sample emitters"},
        {"--shading-normals",
         &c.shading_normals,
         "consistent (smooth meshes get no light from below their geometry, the default), soft "
         "(and "
         "diffuse light fades towards their horizon) or raw (interpolated normals as they are, as "
         "in "
         "Mitsuba 3)",
         {.words = words_of(shading_normals_names)}},
        {"!--no-energy-compensation", &c.energy_compensation, energy_compensation_help},
        {"--sampler",
         &c.sampler,
         "faure (a pattern over the samples of a pixel, the default) or independent",
         {.words = words_of(sample_pattern_names)}},
        {"--replicates",
         &c.replicates,
         "Patterns, each scrambled by itself, that the samples of a pixel take turns in: their "
         "means differ by the error that each has (1)",
         {.domain = replicates_domain}},
        {"--filter-by",
         &c.filter_method,
         "splatting (a sample counts for all pixels that the filter reaches, the default) or "
         "sampling (for one pixel alone: pixels are independent)",
         {.words = words_of(filter_method_names)}},
        {"--aov",
         &c.aovs,
         "Layers beside the image, e.g. albedo,normals,depth",
         {.delimiter = ',', .words = aov_words()}},
        {"--light-group", &c.light_groups,
         "NAME=ID,... (repeat for more): the light of emitters of these ids, or on shapes of these "
         "ids, in a layer light.NAME beside the image; ID alone is a group of that name. What no "
         "group has is light.rest: all add up to the image"},
        {"--light-groups", &c.group_by_light,
         "One for each emitter that has an id, or whose shape has one, and is in no other"},
        {"--cryptomatte",
         &c.cryptomatte,
         "Cryptomatte layers: object (by ids of shapes), material (by ids of their bsdfs)",
         {.delimiter = ',', .words = words_of(cryptomatte_names)}},
        {"--cryptomatte-depth",
         &c.cryptomatte_depth,
         "Names that they keep of a pixel, those that cover most of it (6)",
         {.needs = {"--cryptomatte"}, .domain = cryptomatte_depth_domain}},
        {"-D,--define", &c.definitions,
         "name=value for the scene's $name (repeat for more); of `render` also name=from:step:to"},
        {"--allow-outside", &c.allow_outside, "Let the scene name files outside its own folder"},
        {"--lenient", &c.lenient, lenient_help},
    });
}

std::vector<Option> part_options(RenderCommand& c) {
    return in_group(
        "In parts, and going on",
        {
            {"--checkpoint",
             &c.checkpoint,
             "Keep in this file, from time to time and at the end, what a later render needs to go "
             "on",
             {.kind = ValueKind::file}},
            {"--checkpoint-every",
             &c.checkpoint_every,
             "How often: 90, 90s, 1.5m, 2h",
             {.needs = {"--checkpoint"}}},
            {"--resume",
             &c.resume,
             "Go on from the checkpoint in this file, with as many samples or more; the picture "
             "has "
             "the "
             "bits of a render that was never stopped",
             {.kind = ValueKind::file}},
            {"--continue",
             &c.goes_on,
             "Go on from the file of --checkpoint, if it is there",
             {.needs = {"--checkpoint"}}},
            {"--time-limit", &c.time_limit,
             "Stop after so long (90, 90s, 1.5m, 2h) with what there is of the picture: exit code "
             "99"},
            {"--shard", &c.shard,
             "Render part K of N, K/N, into a .film; `parhelion merge` makes of all parts the "
             "picture "
             "that one render would have made, to the bit"},
            {"--shard-by",
             &c.shard_by,
             "What is shared out: blocks of the picture (the default) or samples, in groups of 16",
             {.needs = {"--shard"}, .words = words_of(sharding_names)}},
        });
}

std::vector<Option> memory_options(RenderCommand& c) {
    return in_group(
        "Memory", {
                      {"--memory", &c.memory,
                       "Memory that the program and the device may take, each: 512M, 2G; the pool "
                       "and what of the film is in memory become smaller, and what needs more is "
                       "refused"},
                      {"--scratch",
                       &c.scratch,
                       "Folder for a film that is more than fits into memory (that of the output)",
                       {.kind = ValueKind::folder}},
                  });
}

std::vector<Option> trace_options(RenderCommand& c) {
    return in_group("One sample instead of an image",
                    {
                        {"--trace",
                         &c.trace,
                         "Tell one sample vertex by vertex, and render nothing",
                         {.needs = {"--pixel", "--sample"}}},
                        {"--pixel",
                         &c.pixel,
                         "Its pixel, X,Y from the top left corner",
                         {.needs = {"--trace"}, .domain = pixel_domain}},
                        {"--sample",
                         &c.sample,
                         "Its number, from 0",
                         {.needs = {"--trace"}, .domain = sample_domain}},
                        {"--json",
                         &c.json_file,
                         "Tell it as JSON, into this file",
                         {.needs = {"--trace"}, .kind = ValueKind::file}},
                    });
}

constexpr const char* split_group = "How work is split (the image stays the same to the bit)";

std::vector<Option> of_split(std::vector<Option> options) {
    return in_group(split_group, std::move(options));
}

std::vector<Option> pool_options(RenderCommand& c) {
    return of_split({
        {"--pool-paths",
         &c.options.split.pool_paths,
         "Paths in flight",
         {.domain = pool_paths_domain}},
        {"--segment-paths",
         &c.options.split.segment_paths,
         "Paths a work-item owns",
         {.domain = segment_paths_domain}},
        {"--streams",
         &c.options.split.streams,
         "Waves under way at once, which share the pool; 0 for what suits the device",
         {.domain = streams_domain}},
    });
}

std::vector<Option> program_options(RenderCommand& c) {
    return of_split({
        {"--work-group-size",
         &c.options.split.work_group_size,
         "Work-items in a group; a device may take fewer",
         {.domain = work_group_domain}},
        {"--lanes",
         &c.options.lanes,
         "Values a kernel handles at once; 0 for the device's",
         {.domain = lanes_domain}},
        {"--portable", &c.options.portable, "Kernels without x86 intrinsics"},
        {"--all-features", &c.options.all_features, "Kernels not specialised to the scene"},
    });
}

} // namespace

std::vector<Option> kernel_options(RenderCommand& c) {
    std::vector<Option> options = light_options(c);
    append(options, {{"--device", &c.device,
                      "Device by index or part of its name (see `parhelion devices`)"},
                     quiet_option(c.quiet),
                     progress_option(c.progress)});
    append(options, program_options(c));
    return options;
}

std::vector<Option> estimate_options(RenderCommand& c) {
    const std::set<std::string> others{"--memory",       "--scratch", "--crop",     "--threads",
                                       "--layer-format", "--shard",   "--shard-by", "--progress",
                                       "--quiet",        "--device"};
    std::vector<Option> options = render_options(c);
    std::erase_if(options, [&](const Option& option) {
        return !option.rules.of_samples && option.rules.group != split_group &&
               !others.contains(option_name(option));
    });
    for (Option& option : options) {
        if (option.rules.group != split_group) option.rules.group.clear();
        if (option_name(option) == "--shard") option.help = "Of part K of N, K/N, alone";
    }
    return options;
}

std::vector<Option> render_options(RenderCommand& c) {
    std::vector<Option> options = sampling_options(c);
    for (const std::vector<Option>& more :
         {image_options(c), picture_form_options(c.form), frame_options(c), part_options(c),
          memory_options(c), trace_options(c), kernel_options(c), pool_options(c)})
        append(options, more);
    return options;
}

} // namespace parhelion
