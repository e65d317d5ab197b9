// Who in a scene names which texture, and the row of each on the device.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/scene/scene.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parhelion {

/// As messages call it.
std::string name_of(const Texture& texture);

/// Rows of textures as parameters name them: the same texture has one row, whoever made it.
class TextureRows {
public:
    int operator()(const TextureUse& use) {
        if (!use) return -1;
        std::vector<int>& alike = by_name_[name_of(*use.texture)];
        auto known = std::find_if(alike.begin(), alike.end(), [&](int row) {
            return textures_[row] == use.texture || *textures_[row] == *use.texture;
        });
        int row = known != alike.end() ? *known : static_cast<int>(textures_.size());
        if (known == alike.end()) {
            alike.push_back(row);
            textures_.push_back(use.texture);
        }
        uses_.emplace_back(row, use);
        return row;
    }
    /// Of what is no surface's: a row of its own.
    int apart(const TextureUse& use) {
        textures_.push_back(use.texture);
        uses_.emplace_back(static_cast<int>(textures_.size()) - 1, use);
        return uses_.back().first;
    }
    const std::vector<std::shared_ptr<const Texture>>& textures() const { return textures_; }
    const std::vector<std::pair<int, TextureUse>>& uses() const { return uses_; }

private:
    std::vector<std::shared_ptr<const Texture>> textures_;
    std::map<std::string, std::vector<int>> by_name_;
    std::vector<std::pair<int, TextureUse>> uses_;
};

/// Rows of the textures of all that names one; -1: none.
struct NamedTextures {
    TextureRows rows;
    std::vector<MaterialTexturesRecord> of_materials;
    std::vector<std::vector<int>> of_numbers; ///< of each material, or empty (number_rows)
    std::vector<int> of_blends, of_shapes;
    std::vector<int> of_emitters; ///< what they shine through: rows behind those of surfaces
    int of_sky = -1;              ///< the last row
};

/// `frame` is that of the records; `lights`: whether those are looked at.
NamedTextures name_textures(const Scene& scene, const SceneFrame& frame, bool lights);

} // namespace parhelion
