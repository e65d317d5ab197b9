// What a scene asks the film to hold beside its picture.
#include "host/flatten/aov_plan.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

/// Place of a kind in its list; the length of the list: there is no such kind.
template<std::size_t N>
int kind_of(const std::array<AovKindInfo, N>& kinds, const std::string& name) {
    auto found = std::find_if(kinds.begin(), kinds.end(),
                              [&](const AovKindInfo& kind) { return kind.name == name; });
    return static_cast<int>(found - kinds.begin());
}

std::string aov_kind_names() {
    std::string text;
    for (const AovKindInfo& kind : aov_kinds)
        text += fmt::format("{}, ", kind.name);
    for (const AovKindInfo& kind : film_aov_kinds)
        text += fmt::format("{}{}", kind.name, kind.name == film_aov_kinds.back().name ? "" : ", ");
    return text;
}

void check_twice(const std::vector<AovLayer>& layers, const AovRequest& request, int kind) {
    for (const AovLayer& layer : layers)
        if (layer.kind == kind || layer.name == request.name)
            throw InputError(fmt::format("{}: AOV '{}' ({}) is asked for twice",
                                         request.location.to_string(), request.name, request.kind));
}

/// Behind all AOVs.
void add_light_groups(const Scene& scene, AovPlan& plan) {
    for (const LightGroup& group : scene.integrator.light_groups) {
        const std::string name = "light." + group.name;
        for (const AovRequest& aov : scene.integrator.aovs)
            if (aov.name == name)
                throw InputError(fmt::format("--light-group: the scene has a layer '{}'", name));
        plan.light_groups.push_back({name, plan.channels});
        plan.channels += 3;
    }
}

AovPlan planned_aovs(const Scene& scene) {
    AovPlan plan;
    for (const AovRequest& request : scene.integrator.aovs) {
        bool of_film = is_film_aov(request);
        int kind =
            of_film ? kind_of(film_aov_kinds, request.kind) : kind_of(aov_kinds, request.kind);
        if (!of_film && kind == aov_kind_count)
            throw InputError(fmt::format("{}: there is no AOV '{}'; there are {}",
                                         request.location.to_string(), request.kind,
                                         aov_kind_names()));
        check_twice(plan.layers, request, of_film ? -1 : kind);
        check_twice(plan.film_layers, request, of_film ? kind : -1);
        if (of_film && kind == film_aov_variance && scene.sampler.samples_per_pixel < 2)
            throw InputError(fmt::format("{}: AOV '{}' needs at least 2 samples per pixel",
                                         request.location.to_string(), request.kind));
        if (of_film) {
            plan.film_layers.push_back({request.name, kind, 0});
            continue;
        }
        plan.layers.push_back({request.name, kind, plan.channels});
        plan.channels += aov_kinds[kind].channels;
    }
    return plan;
}

} // namespace

bool is_film_aov(const AovRequest& request) {
    return kind_of(film_aov_kinds, request.kind) < film_aov_kind_count;
}

AovPlan plan_aovs(const Scene& scene) {
    AovPlan plan = planned_aovs(scene);
    add_light_groups(scene, plan);
    return plan;
}

} // namespace parhelion
