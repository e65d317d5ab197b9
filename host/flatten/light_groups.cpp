// Which of the integrator's light groups an emitter is in.
#include "host/flatten/light_groups.h"

#include <algorithm>
#include <stdexcept>

namespace parhelion {
namespace {

bool names_one(const LightGroup& group, std::initializer_list<std::string_view> ids) {
    return std::any_of(ids.begin(), ids.end(), [&](std::string_view id) {
        return !id.empty() && std::find(group.ids.begin(), group.ids.end(), id) != group.ids.end();
    });
}

} // namespace

int group_of(const std::vector<LightGroup>& groups, std::initializer_list<std::string_view> ids) {
    if (groups.empty()) return 0;
    auto found = std::find_if(groups.begin(), groups.end(),
                              [&](const LightGroup& group) { return names_one(group, ids); });
    if (found == groups.end())
        found = std::find_if(groups.begin(), groups.end(),
                             [](const LightGroup& group) { return group.ids.empty(); });
    if (found == groups.end()) throw std::logic_error("an emitter is in no light group");
    return static_cast<int>(found - groups.begin());
}

std::string_view id_of_emitter(const Scene& scene, std::size_t emitter) {
    return emitter < scene.emitter_ids.size() ? std::string_view(scene.emitter_ids[emitter]) : "";
}

} // namespace parhelion
