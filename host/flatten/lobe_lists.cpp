// Trees of blends, flattened.
#include "host/flatten/lobe_lists.h"

#include <algorithm>

namespace parhelion {
namespace {

struct Share {
    int material;
    double weight;
};

/// The materials of a side, each once, with `weight` to share out among them.
void add_shares(const Scene& scene, int code, double weight, std::vector<Share>& shares) {
    if (IS_BLEND(code)) {
        const Blend& b = scene.blends[static_cast<std::size_t>(BLEND_NUMBER(code))];
        add_shares(scene, b.first, weight * (1.0 - b.weight), shares);
        add_shares(scene, b.second, weight * b.weight, shares);
        return;
    }
    auto same = [code](const Share& s) { return s.material == code; };
    auto known = std::find_if(shares.begin(), shares.end(), same);
    if (known == shares.end())
        shares.push_back({code, weight});
    else
        known->weight += weight;
}

/// The code of the list.
int add_list(const std::vector<Share>& shares, std::vector<LobeRecord>& lobes) {
    int code = blend_code(static_cast<int>(lobes.size()));
    auto behind = static_cast<int>(shares.size());
    double below = 0.0;
    for (const Share& s : shares) {
        lobes.push_back(
            {s.material, static_cast<float>(s.weight), static_cast<float>(below), --behind});
        below += s.weight;
    }
    return code;
}

} // namespace

void add_lobes(const Scene& scene, DeviceScene& out) {
    std::vector<int> codes;
    for (int blend = 0; blend < static_cast<int>(scene.blends.size()); blend++) {
        std::vector<Share> shares;
        add_shares(scene, blend_code(blend), 1.0, shares);
        codes.push_back(add_list(shares, out.lobes));
    }
    auto rename = [&](int& code) {
        if (IS_BLEND(code)) code = codes[static_cast<std::size_t>(BLEND_NUMBER(code))];
    };
    for (ShapeRecord& s : out.geometry.shapes) {
        rename(s.material_front);
        rename(s.material_back);
    }
    for (IndexedPrimitiveRecord& p : out.geometry.primitives)
        rename(p.material);
}

std::vector<LobeRecord> lobes_of(const DeviceScene& records, int code) {
    if (code == no_material) return {};
    if (!IS_BLEND(code)) return {{code, 1.f, 0.f, 0}};
    auto first = records.lobes.begin() + BLEND_NUMBER(code);
    return {first, first + first->behind + 1};
}

} // namespace parhelion
