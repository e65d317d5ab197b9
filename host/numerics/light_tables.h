// The light tree as it should be, in double: what a choice by its nodes gives every light.
#pragma once

#include "host/flatten/device_scene.h"

#include <vector>

#include "host/numerics/measure.h"

namespace parhelion::numerics {

inline f32::LightNode lanes_of(const LightNodeRecord& r) {
    f32::LightNode n{};
#define COPY_FIELD(type, name) n.name = r.name;
    LIGHT_NODE_FIELDS(COPY_FIELD)
    return n;
}

inline f32::Light lanes_of(const LightRecord& r) {
    f32::Light n{};
    LIGHT_FIELDS(COPY_FIELD)
#undef COPY_FIELD
    return n;
}

/// Probability of each light for a surface at p with normal n (`hint`: of any orientation), by
/// walking the whole tree. What is left of 1 belongs to groups that turn out dark.
inline std::vector<double> light_probabilities(const DeviceScene& scene, f32::vec3 p, f32::vec3 n,
                                               bool hint) {
    std::vector<double> pmf(scene.lights.size());
    struct Visit {
        int first;
        double share;
    };
    std::vector<Visit> open{{0, 1.0}};
    while (!open.empty()) {
        Visit v = open.back();
        open.pop_back();
        const LightNodeRecord* pair = &scene.light_tree.nodes[v.first];
        double importance[2];
        for (int k = 0; k < 2; k++) {
            f32::LightImportance i = f32::light_importance(lanes_of(pair[k]), p, n);
            importance[k] = hint ? i.to_point : i.to_surface;
        }
        double sum = importance[0] + importance[1];
        if (!(sum > 0)) continue;
        for (int k = 0; k < 2; k++) {
            int child = pair[k].child;
            double share = v.share * importance[k] / sum;
            if (child >= 0)
                open.push_back({child, share});
            else
                pmf[~child] += share;
        }
    }
    return pmf;
}

} // namespace parhelion::numerics
