// The renders that one command line asks for: several scenes, sweeps of -D, --frames.
#include "host/commands/frames.h"

#include "host/commands/number_ranges.h"
#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace parhelion {
namespace {

namespace fs = std::filesystem;

constexpr const char* frame_name = "frame";

void check_scenes(const std::vector<std::string>& scenes) {
    std::set<std::string> known;
    for (const std::string& scene : scenes) {
        if (scene.empty()) throw InputError("a scene without a name (accepted: a file)");
        if (!known.insert(scene).second) throw InputError(scene + ": is given twice");
        std::error_code error;
        if (scenes.size() > 1 && !fs::exists(scene, error))
            throw InputError(scene + ": no such file");
    }
}

std::string folder_name(const std::string& scene) {
    return fs::absolute(scene).lexically_normal().parent_path().filename().string();
}

std::vector<std::string> as_texts(const std::vector<std::int64_t>& numbers) {
    std::vector<std::string> texts;
    texts.reserve(numbers.size());
    for (const std::int64_t number : numbers)
        texts.push_back(std::to_string(number));
    return texts;
}

} // namespace

Frames::Frames(const RenderCommand& command) : command_(command) {
    scenes_.values = command.scenes;
    if (scenes_.values.empty()) scenes_.values = {command.scene_file};
    check_scenes(scenes_.values);
    add_definitions();
    if (command.frames) axes_.push_back({frame_name, as_texts(parse_frames(*command.frames))});
    count_ = scenes_.values.size();
    for (const Axis& axis : axes_) {
        count_ *= axis.values.size();
        if (count_ > most_renders)
            throw InputError(fmt::format("scenes, sweeps and frames make too many renders "
                                         "(accepted: up to {})",
                                         most_renders));
    }
}

/// The last one of a name counts.
void Frames::add_definitions() {
    parse_definitions(command_.definitions);
    for (const std::string& definition : command_.definitions) {
        const std::string name = definition.substr(0, definition.find('='));
        const std::string value = definition.substr(name.size() + 1);
        if (command_.frames && name == frame_name)
            throw InputError(fmt::format("-D {}: --frames gives ${} its value; give one of them",
                                         definition, frame_name));
        std::vector<std::string> values = parse_sweep("-D " + name, value);
        if (values.empty()) values = {value};
        const auto known = std::find_if(axes_.begin(), axes_.end(),
                                        [&](const Axis& axis) { return axis.name == name; });
        if (known == axes_.end())
            axes_.push_back({name, std::move(values)});
        else
            known->values = std::move(values);
    }
}

Frames::Place Frames::place(std::size_t number) const {
    Place place(axes_.size() + 1);
    for (std::size_t i = axes_.size(); i > 0; i--) {
        const std::size_t values = axes_[i - 1].values.size();
        place[i] = number % values;
        number /= values;
    }
    place[0] = number;
    return place;
}

NameValues Frames::values_at(const Place& place) const {
    NameValues values;
    for (std::size_t i = 0; i < axes_.size(); i++)
        values.values.emplace_back(axes_[i].name, axes_[i].values[place[i + 1]]);
    if (command_.frames) values.frame = std::stoll(values.values.back().second);
    const std::string& scene = scenes_.values[place[0]];
    values.values.emplace_back("scene", fs::path(scene).stem().string());
    values.values.emplace_back("folder", folder_name(scene));
    return values;
}

RenderCommand Frames::command(std::size_t number) const {
    const Place at = place(number);
    RenderCommand one = command_;
    one.scene_file = scenes_.values[at[0]];
    one.scenes = {one.scene_file};
    one.frames.reset();
    one.definitions.clear();
    for (std::size_t i = 0; i < axes_.size(); i++)
        one.definitions.push_back(axes_[i].name + "=" + axes_[i].values[at[i + 1]]);
    const NameValues values = values_at(at);
    one.output = expanded_name("--output", command_.output, values);
    one.stats_file = expanded_name("--stats", command_.stats_file, values);
    one.checkpoint = expanded_name("--checkpoint", command_.checkpoint, values);
    one.resume = expanded_name("--resume", command_.resume, values);
    return one;
}

RenderCommand Frames::only(const std::string& option) const {
    if (several())
        throw InputError(fmt::format(
            "{}: is for one render, and there are {} (accepted: one scene, one frame, no "
            "sweep)",
            option, count_));
    return command(0);
}

std::string Frames::title(std::size_t number) const {
    const Place at = place(number);
    std::string title = scenes_.values.size() > 1 ? scenes_.values[at[0]] : "";
    for (std::size_t i = 0; i < axes_.size(); i++)
        if (axes_[i].values.size() > 1)
            title += fmt::format("{}{}={}", title.empty() ? "" : ", ", axes_[i].name,
                                 axes_[i].values[at[i + 1]]);
    return title;
}

std::vector<std::string> Frames::differences() const {
    std::vector<std::string> names;
    if (scenes_.values.size() > 1) names.emplace_back("$scene");
    for (const Axis& axis : axes_)
        if (axis.values.size() > 1) names.push_back("$" + axis.name);
    return names;
}

} // namespace parhelion
