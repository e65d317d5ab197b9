// All that the device gets of a scene, to be compared with that of the same one in another place.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/numerics/placed_scene.h"
#include "host/waves/render_params.h"

#include <cstring>
#include <string>
#include <type_traits>

namespace parhelion::test {

using namespace parhelion::numerics;

template<class A, class B>
bool same_bytes(const A& a, const B& b) {
    static_assert(std::is_trivially_copyable_v<typename A::value_type>);
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

inline RenderParams params_of(const Scene& scene, const DeviceScene& device) {
    AovPlan aovs = plan_aovs(scene);
    WorkSplit split;
    split.streams = 1;
    WorkSizes sizes = work_sizes(film_layout(scene, aovs), 1, 1, split);
    return render_params(scene, device, sizes, aovs);
}

/// Whether the device gets the same of two scenes, to the bit. `differs`: what does not.
inline bool same_on_device(const Scene& a, const Scene& b, std::string& differs) {
    DeviceScene x = make_device_scene(a), y = make_device_scene(b);
    RenderParams params_x = params_of(a, x), params_y = params_of(b, y);
    differs.clear();
    auto check = [&](bool same, const char* what) {
        if (!same) differs += std::string(" ") + what;
    };
    check(std::memcmp(&params_x, &params_y, sizeof params_x) == 0, "parameters");
    check(same_bytes(x.geometry.primitives, y.geometry.primitives), "primitives");
    check(same_bytes(x.geometry.points, y.geometry.points), "points");
    check(same_bytes(x.geometry.shapes, y.geometry.shapes), "shapes");
    check(same_bytes(x.materials, y.materials), "materials");
    check(same_bytes(x.lights, y.lights), "lights");
    check(same_bytes(x.light_tree.nodes, y.light_tree.nodes), "light nodes");
    check(same_bytes(x.light_tree.leaves, y.light_tree.leaves), "light leaves");
    check(same_bytes(x.bvh.nodes, y.bvh.nodes), "nodes");
    check(same_bytes(x.bvh.leaves, y.bvh.leaves), "leaves");
    check(x.root == y.root && x.camera_root == y.camera_root, "roots");
    check(x.blocking_root == y.blocking_root && x.clear_root == y.clear_root, "shadow rays' roots");
    check(x.sky_light == y.sky_light, "sky");
    check(x.features == y.features, "features");
    return differs.empty();
}

} // namespace parhelion::test
