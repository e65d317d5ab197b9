// The textures of a scene as the device reads them.
#include "host/flatten/texture_records.h"

#include "host/flatten/attribute_texels.h"
#include "host/flatten/daylight.h"
#include "host/flatten/environment_shares.h"
#include "host/flatten/limited_reflectances.h"
#include "host/flatten/material_records.h"
#include "host/flatten/texture_bounds.h"
#include "host/flatten/texture_images.h"
#include "host/flatten/texture_mean.h"
#include "host/flatten/texture_rows.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace parhelion {
namespace {

bool looks_at_lights(const Integrator& integrator) {
    return integrator.kind == IntegratorKind::path || integrator.kind == IntegratorKind::direct;
}

/// Views of geometry look at no material.
bool looks_at_materials(const Integrator& integrator) {
    return looks_at_lights(integrator) ||
           std::any_of(integrator.aovs.begin(), integrator.aovs.end(),
                       [](const AovRequest& a) { return a.kind == "albedo"; });
}

int form_of(const BitmapTexture& bitmap) {
    const TexelLayout& layout = bitmap.source.layout;
    bool linear = bitmap.raw || !layout.srgb;
    return texture_bitmap | (bitmap.filter == TextureFilter::nearest ? TEXTURE_NEAREST : 0) |
           static_cast<int>(bitmap.wrap) << TEXTURE_WRAP_SHIFT |
           (layout.channels == 1 ? TEXTURE_GREY : 0) |
           static_cast<int>(layout.component) << TEXTURE_COMPONENT_SHIFT |
           (linear ? TEXTURE_LINEAR : 0);
}

void set_kind(TextureRecord& t, const BitmapTexture& bitmap, const ImageTexels* image) {
    t.form = form_of(bitmap);
    t.width = bitmap.source.layout.width;
    t.height = bitmap.source.layout.height;
    t.first = static_cast<int>(image->first);
}

void set_kind(TextureRecord& t, const CheckerboardTexture& board, const ImageTexels*) {
    t.form = texture_checkerboard;
    const Rgb &a = board.color0, &b = board.color1;
    t.r0 = static_cast<float>(a.r), t.g0 = static_cast<float>(a.g), t.b0 = static_cast<float>(a.b);
    t.r1 = static_cast<float>(b.r), t.g1 = static_cast<float>(b.g), t.b1 = static_cast<float>(b.b);
}

/// Its words are added behind the images.
void set_kind(TextureRecord& t, const MeshAttributeTexture& attribute, const ImageTexels*) {
    t.form = texture_mesh_attribute | (attribute.of_faces() ? TEXTURE_OF_FACES : 0);
}

TextureRecord texture_record(const Texture& texture, const ImageTexels* image) {
    TextureRecord t{};
    const glm::dmat3& m = texture.to_uv;
    t.ux = static_cast<float>(m[0][0]), t.vx = static_cast<float>(m[0][1]);
    t.uy = static_cast<float>(m[1][0]), t.vy = static_cast<float>(m[1][1]);
    t.ut = static_cast<float>(m[2][0]), t.vt = static_cast<float>(m[2][1]);
    std::visit([&](const auto& kind) { set_kind(t, kind, image); }, texture.kind);
    return t;
}

/// Values that a parameter would be refused with as constants.
void check_values(const TextureRows& rows, const std::vector<ValueBounds>& bounds) {
    for (const auto& [row, use] : rows.uses()) {
        const auto [lowest, highest] = bounds[row];
        if (placed(use.domain, lowest) && placed(use.domain, highest)) continue;
        const std::string found = std::isfinite(lowest)
                                      ? fmt::format("values from {} to {}", lowest, highest)
                                      : fmt::format("a value that is not finite ({})", lowest);
        throw InputError(fmt::format("{}: {} gets {} of {} (accepted: {})",
                                     use.location.to_string(), use.parameter, found,
                                     name_of(*use.texture), accepted_text(use.domain)));
    }
}

/// Between which values each texture stays, but for attributes of meshes.
std::vector<ValueBounds> bounds_of(const TextureRows& rows, const Images& images,
                                   LargeVector<int>& texels) {
    std::vector<ValueBounds> bounds(rows.textures().size());
    parallel_for(bounds.size(), [&](std::size_t row) {
        int image = images.of_row[row];
        std::span<const std::byte> seen;
        if (image >= 0) seen = images.images[image].in(texels);
        bounds[row] = texture_bounds(*rows.textures()[row], seen);
    });
    return bounds;
}

/// Behind what stands in `texels`, and then as many words to spare.
void add_attribute(const Scene& scene, const MeshAttributeTexture& attribute, int row,
                   DeviceScene& out, std::vector<ValueBounds>& bounds) {
    std::size_t first = std::max(out.texels.size(), spare_words) - spare_words;
    AttributeTexels added = attribute_texels(scene, out, attribute, row, first);
    std::size_t table = first + added.values.size(), end = table + added.shapes.size();
    check_words(scene, end);
    out.texels.resize(end + spare_words);
    if (!added.values.empty())
        std::memcpy(&out.texels[first], added.values.data(), added.values.size() * sizeof(float));
    std::copy(added.shapes.begin(), added.shapes.end(), &out.texels[table]);
    std::fill_n(out.texels.end() - spare_words, spare_words, 0);
    out.textures[row].first = static_cast<int>(table);
    if (added.grey) out.textures[row].form |= TEXTURE_GREY;
    bounds[row] = bounds_of_values(added.values);
}

/// The tables of rows of materials that have one, behind what stands in `texels`.
void add_number_rows(const Scene& scene, const std::vector<std::vector<int>>& of_numbers,
                     DeviceScene& out) {
    for (std::size_t material = 0; material < of_numbers.size(); material++) {
        const std::vector<int>& rows = of_numbers[material];
        if (rows.empty()) continue;
        std::size_t first = std::max(out.texels.size(), spare_words) - spare_words;
        check_words(scene, first + rows.size());
        out.texels.resize(first + rows.size() + spare_words);
        std::copy(rows.begin(), rows.end(), &out.texels[first]);
        std::fill_n(out.texels.end() - spare_words, spare_words, 0);
        out.material_textures[material].transmittance = NUMBER_ROWS_CODE(static_cast<int>(first));
    }
}

/// Of all textures, where some light has one.
void add_means(const Scene& scene, const TextureRows& rows, const Images& images,
               DeviceScene& out) {
    auto shines_so = [](const Shape& shape) { return bool(shape.radiance_texture); };
    if (std::none_of(scene.shapes.begin(), scene.shapes.end(), shines_so) &&
        projected_textures(out) == 0)
        return;
    for (std::size_t row = 0; row < rows.textures().size(); row++) {
        int image = images.of_row[row];
        std::span<const std::byte> seen;
        if (image >= 0) seen = images.images[image].in(out.texels);
        out.texture_means.push_back(texture_mean(*rows.textures()[row], seen));
    }
}

void add_attributes(const Scene& scene, const TextureRows& rows, DeviceScene& out,
                    std::vector<ValueBounds>& bounds) {
    for (std::size_t row = 0; row < rows.textures().size(); row++)
        if (const auto* a = std::get_if<MeshAttributeTexture>(&rows.textures()[row]->kind))
            add_attribute(scene, *a, static_cast<int>(row), out, bounds);
}

/// `texture`: the row of the sky's image.
void add_environment(const Scene& scene, int texture, DeviceScene& out) {
    for (const Emitter& emitter : scene.emitters)
        if (const auto* sky = std::get_if<SunskyEmitter>(&emitter)) {
            out.environment = daylight_environment(*sky, out, texture);
            return;
        }
    if (texture >= 0) out.environment = make_environment(out, texture);
}

} // namespace

std::vector<std::shared_ptr<const Texture>> textures_of(const Scene& scene) {
    return name_textures(scene, {}, true).rows.textures();
}

void add_textures(const Scene& scene, DeviceScene* before, DeviceScene& out) {
    out.material_textures.assign(scene.materials.size(), no_textures);
    out.blend_textures.assign(scene.blends.size(), -1);
    out.radiance_textures.assign(scene.shapes.size(), -1);
    out.emitter_textures.assign(scene.emitters.size(), -1);
    if (!looks_at_materials(scene.integrator)) return;
    const NamedTextures named = name_textures(scene, out.frame, looks_at_lights(scene.integrator));
    out.material_textures = named.of_materials;
    out.blend_textures = named.of_blends;
    out.radiance_textures = named.of_shapes;
    out.emitter_textures = named.of_emitters;
    const TextureRows& rows = named.rows;
    const Images images = place_images(scene, rows);
    out.images = read_images(images.images, before, out.texels);
    std::vector<ValueBounds> bounds = bounds_of(rows, images, out.texels);
    bool bytes = false;
    for (std::size_t row = 0; row < rows.textures().size(); row++) {
        int image = images.of_row[row];
        out.textures.push_back(
            texture_record(*rows.textures()[row], image < 0 ? nullptr : &images.images[image]));
        bytes |= image >= 0 && TEXTURE_COMPONENT(out.textures.back().form) == 0;
    }
    add_attributes(scene, rows, out, bounds);
    add_number_rows(scene, named.of_numbers, out);
    check_values(rows, bounds);
    limit_reflectances(scene, rows, images, bounds, out);
    add_means(scene, rows, images, out);
    if (bytes) out.byte_values = make_byte_values();
    add_environment(scene, named.of_sky, out);
}

std::span<const TextureRecord> textures_by_place(const DeviceScene& records) {
    std::size_t of_sky = records.environment.texture >= 0 ? 1 : 0;
    return std::span(records.textures).first(records.textures.size() - of_sky);
}

std::span<const TextureRecord> surface_textures(const DeviceScene& records) {
    std::span<const TextureRecord> all = textures_by_place(records);
    return all.first(all.size() - projected_textures(records));
}

std::size_t projected_textures(const DeviceScene& records) {
    const std::vector<int>& rows = records.emitter_textures;
    return rows.size() - static_cast<std::size_t>(std::count(rows.begin(), rows.end(), -1));
}

std::size_t count_anisotropic(const DeviceScene& records) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < records.materials.size(); i++)
        count += is_anisotropic(records.materials[i], records.material_textures[i]) ? 1 : 0;
    return count;
}

bool reads_uvs(const Scene& scene, const DeviceScene& records) {
    const auto& aovs = scene.integrator.aovs;
    std::span<const TextureRecord> textures = surface_textures(records);
    return std::any_of(textures.begin(), textures.end(),
                       [](const TextureRecord& t) {
                           return TEXTURE_KIND(t.form) != texture_mesh_attribute;
                       }) ||
           std::any_of(aovs.begin(), aovs.end(),
                       [](const AovRequest& a) { return a.kind == "uv"; });
}

} // namespace parhelion
