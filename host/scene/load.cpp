// Reading a scene file into a Scene: the format is chosen by the extension.
#include "host/scene/load.h"

#include "host/scene/mitsuba/scene_builder.h"
#include "host/scene/text.h"

#include <array>
#include <filesystem>

namespace parhelion {

namespace {

struct Format {
    std::string_view extension;
    Scene (*load)(const std::string&, const LoadOptions&);
    std::vector<Construct> (*constructs)(const std::string&, const LoadOptions&);
};

constexpr std::array<Format, 1> formats = {
    {{".xml", mitsuba::load_xml_scene, mitsuba::xml_constructs}}};

const Format& format_of(const std::string& file) {
    const std::filesystem::path path(file);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw InputError(
            file + (std::filesystem::exists(path, error) ? ": not a file" : ": no such file"));
    const std::string extension = lower_case(path.extension().string());
    std::string accepted;
    for (const Format& format : formats) {
        if (format.extension == extension) return format;
        accepted += (accepted.empty() ? "" : ", ") + std::string(format.extension);
    }
    throw InputError(file + ": unknown kind of scene file (accepted: " + accepted + ")");
}

} // namespace

Scene load_scene(const std::string& file, const LoadOptions& options) {
    return format_of(file).load(file, options);
}

std::vector<Construct> scene_constructs(const std::string& file, const LoadOptions& options) {
    return format_of(file).constructs(file, options);
}

} // namespace parhelion
