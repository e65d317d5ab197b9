// Adding to a scene's lists.
#include "host/scene/scene.h"

#include <utility>

namespace parhelion {

int add_material(Scene& scene, Material material) {
    int number = static_cast<int>(scene.materials.size());
    if (material.id.empty()) material.id = "bsdf " + std::to_string(number + 1);
    scene.materials.push_back(std::move(material));
    return number;
}

/// A material that absorbs, for what must be one.
static int add_black(Scene& scene) {
    return add_material(scene, {"absorbs", {}, DiffuseBsdf{Rgb(0.0)}});
}

int add_blend(Scene& scene, Blend blend) {
    if (blend.first == blend.second) return blend.first;
    if (!blend.weight.texture) {
        if (blend.weight.constant == 0.0) return blend.first;
        if (blend.weight.constant == 1.0) return blend.second;
    }
    for (int* part : {&blend.first, &blend.second})
        if (*part == no_material) *part = add_black(scene);
    scene.blends.push_back(std::move(blend));
    return blend_code(static_cast<int>(scene.blends.size()) - 1);
}

} // namespace parhelion
