// What the options of `parhelion render` cannot be whatever the scene.
#include "host/commands/byte_size.h"
#include "host/commands/duration.h"
#include "host/commands/render.h"
#include "host/error.h"
#include "host/image/output.h"
#include "host/progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace parhelion {
namespace {

void check_parts(const RenderCommand& command) {
    if (!command.checkpoint.empty()) parse_duration("--checkpoint-every", command.checkpoint_every);
    if (command.memory) parse_byte_size("--memory", *command.memory);
    if (command.memory && in_double(command))
        throw InputError("--memory: double precision, on the host, takes what it needs");
    if (command.time_limit) parse_duration("--time-limit", *command.time_limit);
    if (command.goes_on && !command.resume.empty())
        throw InputError("--continue: --resume names another film to go on from; give one of them");
}

} // namespace

void check_split(const RenderOptions& options) {
    int most_streams = options.split.pool_paths / BLOCK_PIXELS;
    if (options.split.streams > most_streams)
        throw InputError(fmt::format("--streams {}: there may be 1 to {}, each with at least {} of "
                                     "the pool's paths (0: what suits the device)",
                                     options.split.streams, most_streams, BLOCK_PIXELS));
}

bool in_double(const RenderCommand& command) {
    std::string precision = command.precision.value_or(precision_names[0]);
    if (std::find(precision_names.begin(), precision_names.end(), precision) ==
        precision_names.end())
        throw InputError(fmt::format("--precision '{}': there are {}", precision,
                                     fmt::join(precision_names, ", ")));
    if (precision == "double" && !command.device.empty())
        throw InputError("--device: double precision runs on the host");
    return precision == "double";
}

Shard shard_of(const RenderCommand& command) {
    if (!command.shard) return {};
    Shard shard = parse_shard(*command.shard);
    const std::string by = command.shard_by.value_or("blocks");
    const auto* found = std::find(sharding_names.begin(), sharding_names.end(), by);
    if (found == sharding_names.end())
        throw InputError(
            fmt::format("--shard-by '{}': there are {}", by, fmt::join(sharding_names, ", ")));
    shard.by = static_cast<Sharding>(found - sharding_names.begin());
    return shard;
}

void check_command(const RenderCommand& command) {
    const bool png = !command.shard && image_format(command.output) == ImageFormat::png;
    if (command.exposure && !png)
        throw InputError("--exposure: is for .png previews; an .exr holds linear values");
    if (!command.aovs.empty() && png)
        throw InputError("--aov: a .png preview holds no layers; write an .exr");
    if (!command.cryptomatte.empty() && png)
        throw InputError("--cryptomatte: a .png preview holds no layers; write an .exr");
    if ((!command.light_groups.empty() || command.group_by_light) && png)
        throw InputError("--light-group: a .png preview holds no layers; write an .exr");
    check_picture_form(command.form, command.output);
    check_split(command.options);
    Progress::mode_of(command.progress, command.quiet);
    in_double(command);
    shard_of(command);
    check_parts(command);
}

} // namespace parhelion
