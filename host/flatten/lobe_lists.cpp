// Trees of blends, flattened.
#include "host/flatten/lobe_lists.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace parhelion {
namespace {

struct Share {
    int material = no_material;
    double weight = 1.0;
    std::array<int, LOBE_FACTORS> factors{}; ///< LOBE_FACTOR; 0: none
};

/// What is left of a share for one part of a blend.
Share part_of(const Share& whole, const Blend& blend, int row, bool first) {
    Share part = whole;
    if (!blend.weight.texture) {
        part.weight *= first ? 1.0 - blend.weight.constant : blend.weight.constant;
        return part;
    }
    if (row < 0) return part; // nothing of the image asks for materials
    auto free = std::find(part.factors.begin(), part.factors.end(), 0);
    if (free == part.factors.end())
        throw InputError(fmt::format(
            "{}: {} is a texture, and so are those of {} that hold its plugin, one in the other "
            "(accepted: textures for {} one in the other)",
            blend.weight.texture.location.to_string(), blend.weight.texture.parameter, LOBE_FACTORS,
            LOBE_FACTORS));
    *free = LOBE_FACTOR(row, first);
    return part;
}

/// The materials of a side, with `whole` to share out among them; each once where textures do not
/// tell its shares apart.
void add_shares(const Scene& scene, const DeviceScene& records, int code, const Share& whole,
                std::vector<Share>& shares) {
    if (IS_BLEND(code)) {
        auto number = static_cast<std::size_t>(BLEND_NUMBER(code));
        const Blend& b = scene.blends[number];
        int row = records.blend_textures[number];
        add_shares(scene, records, b.first, part_of(whole, b, row, true), shares);
        add_shares(scene, records, b.second, part_of(whole, b, row, false), shares);
        return;
    }
    auto same = [&](const Share& s) { return s.material == code && s.factors == whole.factors; };
    auto known = std::find_if(shares.begin(), shares.end(), same);
    if (known == shares.end())
        shares.push_back({code, whole.weight, whole.factors});
    else
        known->weight += whole.weight;
}

/// The code of the list.
int add_list(const std::vector<Share>& shares, std::vector<LobeRecord>& lobes) {
    int code = blend_code(static_cast<int>(lobes.size()));
    auto behind = static_cast<int>(shares.size());
    double below = 0.0;
    for (const Share& s : shares) {
        const auto& f = s.factors;
        lobes.push_back({s.material, static_cast<float>(s.weight), static_cast<float>(below),
                         --behind, f[0], f[1], f[2], f[3]});
        below += s.weight;
    }
    return code;
}

} // namespace

void add_lobes(const Scene& scene, DeviceScene& out) {
    std::vector<int> codes;
    for (int blend = 0; blend < static_cast<int>(scene.blends.size()); blend++) {
        std::vector<Share> shares;
        add_shares(scene, out, blend_code(blend), {}, shares);
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
    if (!IS_BLEND(code)) return {{code, 1.f, 0.f, 0, 0, 0, 0, 0}};
    auto first = records.lobes.begin() + BLEND_NUMBER(code);
    return {first, first + first->behind + 1};
}

} // namespace parhelion
