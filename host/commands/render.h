// `parhelion render`: a scene file to an image file.
#pragma once

#include "host/commands/command_line.h"
#include "host/commands/picture_form.h"
#include "host/image/distinct_files.h"
#include "host/render/device_render.h"
#include "host/render/shard.h"
#include "host/scene/load.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// Everything the command line can say; what is absent is the scene's.
struct RenderCommand {
    std::vector<std::string> scenes; ///< as given; `scene_file` is that of one render
    std::string scene_file, output = "out.exr", stats_file, json_file, log_file, device;
    std::string progress = "auto";
    std::vector<std::string> definitions; ///< name=value
    std::vector<std::string> aovs;
    std::vector<std::string> cryptomatte; ///< object, material
    std::optional<int> cryptomatte_depth;
    std::vector<std::string> light_groups; ///< NAME=ID,ID or ID
    bool group_by_light = false;           ///< every emitter that has an id
    std::optional<std::string> integrator, size, crop, sampler, filter_method, precision,
        shading_normals;
    std::optional<int> samples, replicates, max_depth, rr_depth, sensor;
    std::optional<std::uint32_t> seed;
    std::optional<double> exposure;
    PictureForm form;
    std::optional<std::string> pixel; ///< X,Y of the sample to trace
    std::optional<int> sample;        ///< and its number
    bool trace = false;
    int threads = 0; ///< 0: all
    bool next_event = true, energy_compensation = true;
    std::optional<std::string> shard, shard_by, time_limit; ///< K/N, what is shared out, duration
    std::optional<std::string> memory;
    std::string scratch; ///< folder; "": that of the output
    std::string checkpoint, checkpoint_every = "60s", resume;
    bool goes_on = false;              ///< from the checkpoint's file, if it is there
    std::optional<std::string> frames; ///< "1-10"
    bool skip_existing = false, keep_going = false;
    bool force = false, quiet = false, strict = false, allow_outside = false, lenient = false;
    RenderOptions options;
};

/// Loads, renders and writes, each of the renders that it asks for; the exit code. Throws
/// InputError before the output exists that it is about, or DeviceError.
int run_render(const RenderCommand& command);

/// What of it a scene is read by. Throws InputError for definitions that are none.
LoadOptions load_options(const RenderCommand& command);

/// What a scene was read from: no output may be one of them.
std::vector<UsedFile> files_of(const Scene& scene);

/// Replaces what the scene file says by what the command line says. Throws InputError naming the
/// option.
void apply_overrides(const RenderCommand& command, Scene& scene);

/// What --cryptomatte accepts.
inline constexpr std::array cryptomatte_names{"object", "material"};

/// What --precision accepts.
inline constexpr std::array precision_names{"single", "double"};

/// Whether double precision is asked for. Throws InputError for what is no precision, or a device
/// that has none.
bool in_double(const RenderCommand& command);

/// X,Y of a pixel of the film. Throws InputError for one outside.
std::array<int, 2> parse_pixel(const std::string& text, const Film& film);

class RenderMessages;
/// Tells one sample of the scene vertex by vertex, on standard output or into a JSON file; nothing
/// is rendered. Throws InputError.
int run_trace(const RenderCommand& command, const RenderMessages& messages);

/// Rough lobes of single scattering alone, as Mitsuba and others have them.
void leave_out_energy_compensation(Scene& scene);

/// What --sensor and --integrator do, for the options of several subcommands.
inline constexpr const char* sensor_help =
    "Which of the scene's sensors, by its place in the file; `info` names them (0)";
inline constexpr const char* lenient_help =
    "Leave out what is not known, or read it as what is nearest; each is told in a note, and the "
    "notes stand in --stats and in the header of the image";
inline constexpr const char* integrator_help =
    "path, direct, normals, depth or aov; in the place of any that the scene names";

/// What --no-energy-compensation does, for the options of several subcommands.
inline constexpr const char* energy_compensation_help =
    "Rough metal and glass lose what they scatter more than once, as in Mitsuba 3";

Subcommand render_subcommand();

/// All options of `render`, which write to `command`.
std::vector<Option> render_options(RenderCommand& command);

/// Those of them that are about several renders.
std::vector<Option> frame_options(RenderCommand& command);

/// Those of them that have a say in which kernels an image needs.
std::vector<Option> kernel_options(RenderCommand& command);

/// Those of them that have a say in how long a render takes and how much memory.
std::vector<Option> estimate_options(RenderCommand& command);

/// Throws InputError for what cannot be, whatever the scene and the files there are.
void check_command(const RenderCommand& command);

/// The part of the picture that is asked for. Throws InputError for what is none.
Shard shard_of(const RenderCommand& command);

/// Throws InputError for a split that cannot be.
void check_split(const RenderOptions& options);

/// -D name=value pairs. Throws InputError for one without '='.
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions);

} // namespace parhelion
