// `parhelion info`: what is in a scene, and what its kernels will have; what is on a film.
#include "host/commands/info.h"

#include "host/clock.h"
#include "host/commands/byte_size.h"
#include "host/commands/command_text.h"
#include "host/commands/estimate_info.h"
#include "host/commands/film_info.h"
#include "host/commands/info_text.h"
#include "host/commands/option_number.h"
#include "host/commands/render.h"
#include "host/commands/render_outputs.h"
#include "host/commands/scene_check.h"
#include "host/commands/thread_limit.h"
#include "host/error.h"
#include "host/flatten/device_scene.h"
#include "host/flatten/kind_names.h"
#include "host/flatten/texture_records.h"
#include "host/image/output.h"
#include "host/json_text.h"
#include "host/render/report.h"
#include "host/scene/load.h"
#include "host/streams.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <memory>

namespace parhelion {
namespace {

struct InfoCommand {
    RenderCommand image; ///< what of it decides which kernels there are
    bool json = false, check = false, estimate = false;
};

/// Of textures that are images: what their files hold.
nlohmann::json image_of(const BitmapTexture& bitmap) {
    const TexelLayout& layout = bitmap.source.layout;
    return {{"kind", "bitmap"},
            {"file", bitmap.source.name},
            {"width_texels", layout.width},
            {"height_texels", layout.height},
            {"components", layout.channels},
            {"component", texel_component_names[static_cast<std::size_t>(layout.component)]},
            {"bytes", layout.bytes()}};
}
nlohmann::json image_of(const CheckerboardTexture&) { return {{"kind", "checkerboard"}}; }
nlohmann::json image_of(const MeshAttributeTexture& attribute) {
    return {{"kind", "mesh_attribute"}, {"name", attribute.name}};
}

nlohmann::json describe_textures(const Scene& scene) {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& texture : textures_of(scene))
        all.push_back(std::visit([](const auto& kind) { return image_of(kind); }, texture->kind));
    return all;
}

nlohmann::json describe(const Scene& scene, const DeviceScene& flat) {
    std::map<std::string, int> shapes, materials, lights;
    std::size_t triangles = 0;
    for (const Shape& shape : scene.shapes) {
        shapes[shape.plugin]++;
        if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry))
            triangles += mesh->triangles.size();
    }
    std::vector<std::string> notes = scene.notes;
    notes.insert(notes.end(), flat.notes.begin(), flat.notes.end());
    for (const MaterialRecord& m : flat.materials)
        materials[material_names[m.kind]]++;
    for (const LightRecord& l : flat.lights)
        lights[emitter_names[l.kind]]++;
    return {{"scene", scene.file},
            {"sensors", scene.sensors},
            {"film", film_size_json(scene.film)},
            {"samples_per_pixel", scene.sampler.samples_per_pixel},
            {"frame", to_json(flat.frame)},
            {"shapes", shapes},
            {"triangles", triangles},
            {"primitives", flat.geometry.primitives.size()},
            {"materials", materials},
            {"lights", lights},
            {"textures", describe_textures(scene)},
            {"texture_bytes", 4 * flat.texels.size()},
            {"bvh",
             {{"nodes", flat.bvh_statistics.node_count},
              {"leaves", flat.bvh_statistics.leaf_count},
              {"bytes", flat.bvh_statistics.bytes},
              {"depth", flat.bvh_statistics.depth},
              {"sah_cost", flat.bvh_statistics.sah_cost},
              {"leaf_fill", flat.bvh_statistics.leaf_fill}}},
            {"device_scene_bytes", flat.bytes()},
            {"kernel_features", flat.features.on().names()},
            {"skipped_features", (FeatureSet::all() - flat.features.on()).names()},
            {"feature_reasons", flat.features.reasons()},
            {"notes", notes}};
}

std::string counted(const nlohmann::json& kinds) {
    std::string text;
    for (const auto& [name, count] : kinds.items())
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count.get<int>(), name);
    return text.empty() ? "none" : text;
}

std::string joined(const nlohmann::json& names) {
    return fmt::format("{}", fmt::join(names.get<std::vector<std::string>>(), " "));
}

std::string texture_text(const nlohmann::json& t) {
    if (t.contains("name")) return fmt::format("mesh_attribute {}", t["name"].get<std::string>());
    if (!t.contains("file")) return t["kind"].get<std::string>();
    return fmt::format("{} {} x {} texels, {} x {}, {} bytes: {}", t["kind"].get<std::string>(),
                       t["width_texels"].get<int>(), t["height_texels"].get<int>(),
                       t["components"].get<int>(), t["component"].get<std::string>(),
                       t["bytes"].get<std::size_t>(), t["file"].get<std::string>());
}

std::string text_of(const nlohmann::json& info) {
    const nlohmann::json &frame = info["frame"], &bvh = info["bvh"];
    InfoText text(info["scene"].get<std::string>());
    const auto add = [&text](const char* label, const std::string& line) { text.add(label, line); };
    add("film", film_size_text(info["film"], info["samples_per_pixel"].get<int>()));
    if (info["sensors"].size() > 1)
        add("sensors",
            fmt::format("{}", fmt::join(info["sensors"].get<std::vector<std::string>>(), ", ")));
    add("frame", fmt::format("centre ({:g}), unit 2^{}",
                             fmt::join(frame["centre"].get<std::vector<double>>(), ", "),
                             frame["unit_exponent"].get<int>()));
    add("shapes", fmt::format("{} ({} triangles)", counted(info["shapes"]),
                              info["triangles"].get<std::size_t>()));
    add("materials", counted(info["materials"]));
    add("lights", counted(info["lights"]));
    add("textures", fmt::format("{} ({:.1f} MB)", info["textures"].size(),
                                info["texture_bytes"].get<double>() / 1e6));
    for (const auto& texture : info["textures"])
        add("", texture_text(texture));
    add("BVH", fmt::format("{} nodes, {} leaves, depth {}, SAH cost {:.2f}",
                           bvh["nodes"].get<std::size_t>(), bvh["leaves"].get<std::size_t>(),
                           bvh["depth"].get<int>(), bvh["sah_cost"].get<double>()));
    add("memory",
        fmt::format("{:.1f} MB on the device", info["device_scene_bytes"].get<double>() / 1e6));
    if (info.contains("estimate")) add_estimate(info["estimate"], text);
    add("kernels", joined(info["kernel_features"]));
    add("left out", joined(info["skipped_features"]));
    for (const auto& note : info["notes"])
        add("note", note.get<std::string>());
    return text.text();
}

std::vector<Option> info_options(InfoCommand& c) {
    std::vector<Option> options{
        {"scene",
         &c.image.scene_file,
         "Scene file (Mitsuba 3 XML), or a film that --checkpoint or --shard wrote",
         {.required = true, .kind = ValueKind::file}},
        {"--check", &c.check,
         "Say of everything in the file whether it is rendered as written, approximately (and "
         "how) or refused (and what --lenient makes of it): exit code 0, 1 or 2"},
        {"--estimate", &c.estimate,
         "Begin the render, for two seconds, and say how long all of it would take and how much "
         "memory; takes what `render` takes beside"},
        {"--json", &c.json, "One JSON object"}};
    for (Option& option : estimate_options(c.image))
        options.push_back(std::move(option));
    return options;
}

int run_check(const InfoCommand& command) {
    nlohmann::json check = check_scene(command.image.scene_file, load_options(command.image));
    print(command.json ? json_text(check) : check_text(check));
    return static_cast<int>(check_exit_code(check));
}

/// Of a film nothing else can be asked.
int run_film_info(InfoCommand& command) {
    for (const Option& option : info_options(command))
        if (const std::string name = option_name(option);
            name != "--json" && name != "--quiet" && !given_option(option).empty())
            throw InputError(fmt::format("{}: is for scenes; {} is a film of samples", name,
                                         command.image.scene_file));
    const nlohmann::json info = describe_film(FilmFile(command.image.scene_file));
    print(command.json ? json_text(info) : film_text(info));
    return static_cast<int>(ExitCode::ok);
}

/// Refuses what cannot be before the scene is read.
void check_info(const InfoCommand& command) {
    if (command.check && command.estimate)
        throw InputError("--estimate: --check renders nothing (accepted: one of the two)");
    check_split(command.image.options);
    shard_of(command.image);
    if (command.image.memory) parse_byte_size("--memory", *command.image.memory);
    if (!command.image.scratch.empty()) check_folder("--scratch", command.image.scratch);
}

int run_scene_info(const InfoCommand& command) {
    const auto start = Clock::now();
    const Progress::Mode mode = Progress::mode_of(command.image.progress, command.image.quiet);
    tell_messages_as(mode == Progress::Mode::json ? MessageForm::json : MessageForm::text);
    Progress progress(command.estimate ? mode : Progress::Mode::quiet);
    check_info(command);
    if (command.check) return run_check(command);
    const ThreadLimit threads(command.image.threads);
    progress.start("loading", command.image.scene_file);
    Scene scene = load_scene(command.image.scene_file, load_options(command.image));
    apply_overrides(command.image, scene);
    progress.finish("");
    // First: what describes the scene has no say in what a render takes.
    nlohmann::json found;
    if (command.estimate) found = estimate(command.image, scene, seconds_since(start), progress);
    nlohmann::json info = describe(scene, make_device_scene(scene));
    if (command.estimate) info["estimate"] = found;
    print(command.json ? json_text(info) : text_of(info));
    return static_cast<int>(ExitCode::ok);
}

int run_info(InfoCommand& command) {
    return is_to_be_film(command.image.scene_file) ? run_film_info(command)
                                                   : run_scene_info(command);
}

} // namespace

Subcommand info_subcommand() {
    auto c = std::make_shared<InfoCommand>();
    return {
        .name = "info",
        .summary = "Say what is in a scene, what its kernels will have and what it will take, or "
                   "what is on a "
                   "film",
        .examples =
            "Examples:\n"
            "  parhelion info scenes/cornell-box/scene.xml --json | jq .kernel_features\n"
            "  parhelion info theirs.xml --check   # what of it is exact, approximated, refused; "
            "exit code 0, 1, 2\n"
            "  parhelion info scene.xml --estimate --spp 4096 --size 1920x1080   # time and "
            "memory, "
            "beforehand\n"
            "  parhelion info long.film   # a checkpoint, or a part of a render: what is on it",
        .options = info_options(*c),
        .run = [c] { return run_info(*c); },
    };
}

} // namespace parhelion
