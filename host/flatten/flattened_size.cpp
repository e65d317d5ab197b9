// How much memory the records of a scene take, before they are made.
#include "host/flatten/flattened_size.h"

#include "host/flatten/device_scene.h"
#include "host/flatten/texture_images.h"

#include <algorithm>

namespace parhelion {
namespace {

std::uint64_t geometry_bytes(const Scene& scene) {
    std::uint64_t primitives = 0, vertices = 0;
    for (const Shape& shape : scene.shapes) {
        primitives += primitive_count(shape);
        if (const auto* mesh = std::get_if<Mesh>(&shape.geometry))
            vertices += mesh->normals.empty() && mesh->uvs.empty() ? 0 : mesh->positions.size();
    }
    // What lets light through has a second tree.
    const bool two_trees = !scene.blends.empty() || scene.integrator.hide_emitters;
    constexpr std::uint64_t of_primitive = 150, of_tree = 80, of_vertex = 40;
    return (of_primitive + (two_trees ? of_tree : 0)) * primitives + of_vertex * vertices;
}

std::uint64_t image_bytes(const Scene& scene) {
    const NamedTextures named = name_textures(scene, {}, true);
    const Images placed = place_images(scene, named.rows);
    std::uint64_t bytes = 0;
    for (const ImageTexels& image : placed.images)
        bytes += image.bitmap->source.layout.bytes();
    // Of a sky, how likely each of its texels is.
    constexpr std::uint64_t of_texel = 24;
    const int sky = named.of_sky >= 0 ? placed.of_row[named.of_sky] : -1;
    if (sky >= 0) bytes += of_texel * placed.images[sky].bitmap->source.layout.texels();
    return bytes;
}

} // namespace

std::uint64_t most_flattened_bytes(const Scene& scene) {
    constexpr std::uint64_t tables = 8 << 20; // of features, filters and energies
    return tables + geometry_bytes(scene) + image_bytes(scene);
}

} // namespace parhelion
