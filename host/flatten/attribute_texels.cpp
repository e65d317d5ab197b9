// Attributes of meshes as textures look them up.
#include "host/flatten/attribute_texels.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace parhelion {
namespace {

/// Whether a side of a shape does: a material, or one of a blend.
bool looks_up(const Scene& scene, const DeviceScene& records, int code, int row) {
    if (code == no_material) return false;
    if (IS_BLEND(code)) {
        const Blend& b = scene.blends[BLEND_NUMBER(code)];
        return records.blend_textures[BLEND_NUMBER(code)] == row ||
               looks_up(scene, records, b.first, row) || looks_up(scene, records, b.second, row);
    }
    const MaterialTexturesRecord& t = records.material_textures[code];
#define IS_ROW(type, name) || t.name == row
    return false MATERIAL_TEXTURES_FIELDS(IS_ROW);
#undef IS_ROW
}

std::string names_of(const Mesh& mesh) {
    std::string names;
    for (const MeshAttribute& a : mesh.attributes)
        names += (names.empty() ? "" : ", ") + a.name;
    return names.empty() ? "none" : names;
}

const MeshAttribute& attribute_of(const Shape& shape, const std::string& name) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh)
        for (const MeshAttribute& attribute : mesh->attributes)
            if (attribute.name == name) return attribute;
    throw InputError(fmt::format(
        "{}: shape plugin \"{}\" has no attribute \"{}\", which its bsdf looks up (it has: {})",
        shape.location.to_string(), shape.plugin, name, mesh ? names_of(*mesh) : "none"));
}

/// The value of a vertex or a face, three times where it is one.
std::array<float, 3> value_at(const MeshAttribute& attribute, std::size_t entry, double scale) {
    std::array<float, 3> value{};
    for (int c = 0; c < 3; c++) {
        int channel = attribute.channels == 1 ? 0 : c;
        float stored = attribute.values[entry * attribute.channels + channel];
        value[c] = static_cast<float>(scale * stored);
    }
    return value;
}

void add_values(const Mesh& mesh, const MeshAttribute& attribute, double scale,
                std::vector<float>& to) {
    auto add = [&](std::size_t entry) {
        std::array<float, 3> value = value_at(attribute, entry, scale);
        to.insert(to.end(), value.begin(), value.end());
    };
    for (std::size_t face = 0; face < mesh.triangles.size(); face++) {
        if (attribute.of_faces()) {
            add(face);
            continue;
        }
        for (int corner = 0; corner < 3; corner++)
            add(mesh.triangles[face][corner]);
    }
}

} // namespace

AttributeTexels attribute_texels(const Scene& scene, const DeviceScene& records,
                                 const MeshAttributeTexture& attribute, int row,
                                 std::size_t first_word) {
    AttributeTexels texels;
    texels.shapes.assign(std::max<std::size_t>(scene.shapes.size(), 1), 0);
    std::size_t words = attribute.of_faces() ? 3 : 9, primitives = 0;
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        const Shape& shape = scene.shapes[i];
        if (primitive_count(shape) > 0 && (looks_up(scene, records, shape.material_front, row) ||
                                           looks_up(scene, records, shape.material_back, row) ||
                                           records.radiance_textures[i] == row)) {
            const MeshAttribute& found = attribute_of(shape, attribute.name);
            texels.shapes[i] = static_cast<int>(first_word + texels.values.size()) -
                               static_cast<int>(words * primitives);
            texels.grey &= found.channels == 1;
            add_values(std::get<Mesh>(shape.geometry), found, attribute.scale, texels.values);
        }
        primitives += primitive_count(shape);
    }
    return texels;
}

} // namespace parhelion
