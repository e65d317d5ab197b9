// Properties of a PLY file that are attributes of a mesh, as Mitsuba 3 names and groups them.
#include "host/scene/meshes/ply_attributes.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace parhelion {

namespace {

using Names = std::array<std::string_view, 3>;

constexpr Names numbers = {"0", "1", "2"}, colors = {"r", "g", "b"},
                long_colors = {"red", "green", "blue"};

/// A name in front of its last underscore, and what stands behind; the whole name where there is
/// none.
std::pair<std::string_view, std::string_view> parted(std::string_view name) {
    const std::size_t at = name.rfind('_');
    if (at == std::string_view::npos) return {name, {}};
    return {name.substr(0, at), name.substr(at + 1)};
}

class Grouping {
public:
    Grouping(const PlyElement& element, const std::vector<bool>& taken)
        : element_(element), free_(element.properties.size()) {
        found_.places.resize(element.properties.size());
        for (std::size_t k = 0; k < free_.size(); ++k)
            free_[k] = !taken[k] && !element.properties[k].list;
    }

    PlyAttributes found() && {
        add_color(colors);
        add_color(long_colors);
        for (std::size_t k = 0; k < free_.size(); ++k)
            if (free_[k]) add_group(k);
        return std::move(found_);
    }

private:
    void add(const std::string& name, const std::vector<std::size_t>& properties) {
        const auto number = static_cast<int>(found_.attributes.size());
        found_.attributes.push_back(
            {element_.name + "_" + name, static_cast<int>(properties.size()), {}});
        for (std::size_t channel = 0; channel < properties.size(); ++channel) {
            free_[properties[channel]] = false;
            found_.places[properties[channel]] = {number, static_cast<int>(channel)};
        }
    }

    bool is_known(const std::string& name) const {
        return std::any_of(
            found_.attributes.begin(), found_.attributes.end(),
            [&](const MeshAttribute& a) { return a.name == element_.name + "_" + name; });
    }

    void add_color(const Names& names) {
        std::vector<std::size_t> properties;
        for (const std::string_view name : names)
            for (std::size_t k = 0; k < free_.size(); ++k)
                if (free_[k] && element_.properties[k].name == name) {
                    properties.push_back(k);
                    break;
                }
        if (properties.size() == 3 && !is_known("color")) add("color", properties);
    }

    /// From property `first` on, as many as have its name up to the last underscore.
    void add_group(std::size_t first) {
        const std::string prefix(parted(element_.properties[first].name).first);
        std::vector<std::size_t> group;
        std::vector<std::string_view> ends;
        for (std::size_t k = first; k < free_.size() && free_[k]; ++k) {
            const auto [front, end] = parted(element_.properties[k].name);
            if (front != prefix || end.empty()) break;
            group.push_back(k);
            ends.push_back(end);
        }
        const auto ends_in = [&](const Names& names) {
            return std::equal(ends.begin(), ends.end(), names.begin());
        };
        const bool one = group.size() == 1 && ends[0] == numbers[0], three = group.size() == 3;
        if (is_known(prefix)) return;
        if (one || (three && ends_in(numbers)))
            add(prefix, group);
        else if (three && ends_in(colors))
            add(prefix + "_color", group);
        else // none of what stands here begins another one
            for (const std::size_t k : group)
                free_[k] = false;
    }

    const PlyElement& element_;
    std::vector<bool> free_; ///< properties that are nothing yet
    PlyAttributes found_;
};

} // namespace

PlyAttributes attributes_of(const PlyElement& element, const std::vector<bool>& taken) {
    return Grouping(element, taken).found();
}

PlyAttributeRow::PlyAttributeRow(PlyAttributes layout)
    : layout_(std::move(layout)), row_(layout_.attributes.size()) {}

void PlyAttributeRow::set(std::size_t property, double value) {
    const PlyAttributes::Place place = layout_.places[property];
    row_[static_cast<std::size_t>(place.attribute)][static_cast<std::size_t>(place.channel)] =
        static_cast<float>(value);
}

void PlyAttributeRow::add_to(std::vector<MeshAttribute>& attributes, std::size_t first,
                             std::size_t entries) {
    for (std::size_t entry = 0; entry < entries; ++entry)
        for (std::size_t k = 0; k < row_.size(); ++k) {
            MeshAttribute& to = attributes[first + k];
            to.values.insert(to.values.end(), row_[k].begin(), row_[k].begin() + to.channels);
        }
}

} // namespace parhelion
