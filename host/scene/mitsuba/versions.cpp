// Versions of the format, and what files older than 2.0 write otherwise.
#include "host/scene/mitsuba/versions.h"

#include "host/scene/text.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace parhelion::mitsuba {

namespace {

constexpr int newest_version = 3; ///< of the format that is read

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// Takes the number `name` out of the object; sets `number`, and `place` to where it stands.
void take_number(Object& object, std::string_view name, double& number, Parameter& place) {
    const auto found = std::find_if(object.parameters.begin(), object.parameters.end(),
                                    [&](const Parameter& p) { return p.name == name; });
    if (found == object.parameters.end()) return;
    if (const auto* real = std::get_if<double>(&found->value))
        number = *real;
    else if (const auto* whole = std::get_if<std::int64_t>(&found->value))
        number = static_cast<double>(*whole);
    else
        return;
    if (place.name.empty()) place = *found;
    object.parameters.erase(found);
}

void join_uv_transform(Object& object) {
    glm::dvec3 offset(0.0), scale(1.0);
    Parameter joined;
    take_number(object, "uoffset", offset.x, joined);
    take_number(object, "voffset", offset.y, joined);
    take_number(object, "uscale", scale.x, joined);
    take_number(object, "vscale", scale.y, joined);
    if (joined.name.empty()) return;
    joined.name = "to_uv";
    joined.tag = "transform";
    joined.value = glm::translate(glm::scale(glm::dmat4(1.0), scale), offset);
    object.parameters.push_back(std::move(joined));
}

} // namespace

std::array<int, 3> parse_version(std::string_view text, const SourceLocation& place,
                                 std::vector<std::string>& notes) {
    const std::vector<std::string_view> parts = split(text, ".");
    const auto dots = std::count(text.begin(), text.end(), '.');
    std::array<int, 3> version{};
    bool good = !parts.empty() && parts.size() <= 3 && dots == std::ssize(parts) - 1;
    for (std::size_t i = 0; good && i < parts.size(); ++i) {
        const std::optional<std::int64_t> number = parse_integer(parts[i]);
        good = number && *number >= 0 && *number <= 9999;
        if (good) version[i] = static_cast<int>(*number);
    }
    if (!good)
        refuse(place, "version " + in_quotes(text) + " is not a version number such as \"3.0.0\"");
    if (version[0] > newest_version)
        notes.push_back(place.to_string() + ": version " + in_quotes(text) +
                        " of the format is newer than " + std::to_string(newest_version) +
                        ", as which the file is read");
    return version;
}

std::string snake_case(std::string_view name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (i > 0 && is_lower(name[i - 1]) && is_upper(name[i])) {
            result += '_';
            for (; i < name.size() && is_upper(name[i]); ++i)
                result += static_cast<char>(name[i] - 'A' + 'a');
            --i;
        } else {
            result += name[i];
        }
    }
    return result;
}

void upgrade_old_object(Object& object) {
    object.before_2_0 = true;
    for (Child& child : object.children)
        child.name = snake_case(child.name);
    const auto rename = [](auto& named) {
        if (named.name == "diffuse_reflectance") named.name = "reflectance";
    };
    if (object.plugin == "diffuse") {
        std::for_each(object.parameters.begin(), object.parameters.end(), rename);
        std::for_each(object.children.begin(), object.children.end(), rename);
    }
    join_uv_transform(object);
}

} // namespace parhelion::mitsuba
