// What a render is made from.
#include "host/commands/render_key.h"

#include "host/cl/embedded_kernels.h"
#include "host/commands/command_text.h"
#include "host/commands/option_number.h"
#include "host/digest.h"
#include "host/error.h"
#include "parhelion_version.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace parhelion {
namespace {

std::string kernels_digest() {
    std::string all;
    for (const EmbeddedFile& file : embedded_kernels())
        all += fmt::format("{} {}\n{}", file.path, file.text.size(), file.text);
    return digest_of(all);
}

/// Scenes move from machine to machine with their folder.
std::string name_in_folder(const std::string& file, const std::string& scene_file) {
    const std::filesystem::path folder = std::filesystem::absolute(scene_file).parent_path();
    return std::filesystem::absolute(file).lexically_relative(folder).string();
}

/// Of " --name value", of a flag " --name".
std::string value_of(const std::string& given, const std::string& name) {
    const std::string value = given.substr(1 + name.size());
    return value.empty() ? "given" : value.substr(1);
}

} // namespace

RenderKey render_key(const RenderCommand& command, const Scene& scene, FileDigests* digests) {
    FileDigests once;
    if (!digests) digests = &once;
    RenderKey key{{"the program", fmt::format("{} {}", version_number, version_commit)},
                  {"its kernels", kernels_digest()},
                  {"the scene", digests->of(scene.file)}};
    std::vector<std::string> files = scene.files;
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    for (const std::string& file : files)
        key.emplace_back("file " + name_in_folder(file, scene.file), digests->of(file));
    RenderCommand asked = command;
    asked.definitions.clear();
    for (const auto& [name, value] : parse_definitions(command.definitions)) // in one order
        asked.definitions.push_back(name + "=" + value);
    for (const Option& option : render_options(asked))
        if (option.rules.of_samples || option.rules.of_film)
            if (const std::string name = option_name(option); name != "--spp")
                if (const std::string given = given_option(option); !given.empty())
                    key.emplace_back(name, value_of(given, name));
    return key;
}

std::string render_digest(const RenderKey& key, int samples_per_pixel) {
    std::string all = fmt::format("{}", samples_per_pixel);
    for (const auto& [name, value] : key)
        all += fmt::format("\n{} {}: {}", name.size(), name, value);
    return digest_of(all);
}

void check_same_render(const FilmFile& film, const RenderKey& key) {
    const std::string what = key_difference(film.header().key, key);
    if (!what.empty())
        throw InputError(fmt::format("{}: is the film of another render: {} (accepted: the same "
                                     "scene, files, options and program)",
                                     film.name(), what));
}

} // namespace parhelion
