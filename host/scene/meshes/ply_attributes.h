// Properties of a PLY file that are attributes of a mesh, as Mitsuba 3 names and groups them.
#pragma once

#include "host/scene/meshes/ply_header.h"
#include "host/scene/shape.h"

#include <array>
#include <vector>

namespace parhelion {

/// Which of an element's properties are values of which attribute.
struct PlyAttributes {
    std::vector<MeshAttribute> attributes; ///< without values
    struct Place {
        int attribute = -1; ///< -1: of none
        int channel = 0;
    };
    std::vector<Place> places; ///< of each property
};

/// Of properties that `taken` does not say of that they are something else: r, g, b (or red, green,
/// blue) are the attribute "color"; what stands side by side as name_0, name_1, name_2 (or name_0
/// alone) is "name", as name_r, name_g, name_b "name_color". In front stands the element's name.
PlyAttributes attributes_of(const PlyElement& element, const std::vector<bool>& taken);

/// Where a row's values go, and then, when it is whole, where that many entries get them.
class PlyAttributeRow {
public:
    explicit PlyAttributeRow(PlyAttributes layout);

    bool has(std::size_t property) const { return layout_.places[property].attribute >= 0; }
    void set(std::size_t property, double value);
    void add_to(std::vector<MeshAttribute>& attributes, std::size_t first, std::size_t entries);
    const std::vector<MeshAttribute>& attributes() const { return layout_.attributes; }

private:
    PlyAttributes layout_;
    std::vector<std::array<float, 3>> row_;
};

} // namespace parhelion
