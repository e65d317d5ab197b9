// Reflectances of one material that are to be at most 1 together, where textures tell of them.
#include "host/flatten/limited_reflectances.h"

#include "host/flatten/material_records.h"
#include "host/flatten/texture_mean.h"

#include <variant>

namespace parhelion {
namespace {

/// Of each component the highest that a parameter's texture has, or what it is without one.
class Highest {
public:
    Highest(const TextureRows& rows, const Images& images, DeviceScene& scene,
            const std::vector<ValueBounds>& bounds)
        : rows_(rows), images_(images), scene_(scene), bounds_(bounds) {}

    Rgb operator()(const Textured<Rgb>& color, int row) const {
        if (!color.texture) return color.constant;
        const Texture& texture = *rows_.textures()[row];
        if (std::holds_alternative<MeshAttributeTexture>(texture.kind))
            return Rgb(bounds_[row].highest);
        int image = images_.of_row[row];
        std::span<const std::byte> seen;
        if (image >= 0) seen = images_.images[image].in(scene_.texels);
        return texture_highest(texture, seen);
    }

private:
    const TextureRows& rows_;
    const Images& images_;
    DeviceScene& scene_;
    const std::vector<ValueBounds>& bounds_;
};

} // namespace

void limit_reflectances(const Scene& scene, const TextureRows& rows, const Images& images,
                        const std::vector<ValueBounds>& bounds, DeviceScene& out) {
    const Highest highest(rows, images, out, bounds);
    for (std::size_t i = 0; i < scene.materials.size(); i++) {
        auto limit = [&](const auto& b) {
            if constexpr (requires { b.ensure_energy_conservation; }) {
                const Textured<Rgb>&diffuse = b.diffuse_reflectance,
                      &specular = b.specular_reflectance;
                if (!diffuse.texture && !specular.texture) return;
                const MaterialTexturesRecord& t = out.material_textures[i];
                scale_reflectances(out.materials[i],
                                   kept_share(b, highest(diffuse, t.reflectance),
                                              highest(specular, t.transmittance)));
            }
        };
        std::visit(limit, scene.materials[i].bsdf);
    }
}

} // namespace parhelion
