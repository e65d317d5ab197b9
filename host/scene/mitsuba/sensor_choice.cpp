// Which of a file's sensors is used, and what is seen where it has none.
#include "host/scene/mitsuba/sensor_choice.h"

#include "host/scene/shape_bounds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::mitsuba {

std::vector<std::string> sensor_names(const Document& document,
                                      const std::vector<const Child*>& sensors) {
    std::vector<std::string> names;
    for (const Child* const sensor : sensors) {
        const std::string& id = document.objects[sensor->object].id;
        names.push_back(id.empty() ? fmt::format("sensor {}", names.size()) : id);
    }
    return names;
}

std::size_t chosen_sensor(const std::vector<std::string>& names, std::optional<int> wanted,
                          const std::string& file, std::vector<std::string>& notes) {
    const int count = static_cast<int>(names.size());
    if (wanted && (*wanted < 0 || *wanted >= count))
        throw InputError(fmt::format("--sensor {}: {} has {} (accepted: {})", *wanted, file,
                                     count == 1 ? "1 sensor" : fmt::format("{} sensors", count),
                                     count == 0   ? "none"
                                     : count == 1 ? "0"
                                                  : fmt::format("0 to {}", count - 1)));
    if (count == 0)
        notes.push_back(file +
                        ": the scene has no <sensor>; a view along +z of all shapes, 45 "
                        "degrees wide, is used, as in Mitsuba 2 (Mitsuba 3 renders nothing)");
    if (count > 1 && !wanted)
        notes.push_back(fmt::format("{}: the scene has {} sensors ({}); the first is used "
                                    "(--sensor N, from 0, chooses another)",
                                    file, count, fmt::join(names, ", ")));
    return static_cast<std::size_t>(wanted.value_or(0));
}

Camera default_view(const std::vector<Shape>& shapes) {
    constexpr double field = 45.0; // degrees
    Camera camera;
    camera.fov_degrees = field;
    ShapeBounds box;
    for (const Shape& shape : shapes)
        box = join(box, bounds_of(shape.geometry, glm::dvec3(0.0)));
    if (box.empty()) return camera;
    const glm::dvec3 centre = 0.5 * (box.low + box.high), extent = box.high - box.low;
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (largest == 0.0) return camera;
    const double distance = largest / (2.0 * std::tan(0.5 * glm::radians(field)));
    camera.near_clip = distance / 100.0;
    camera.far_clip = largest * 5.0 + distance;
    camera.to_world =
        glm::translate(glm::dmat4(1.0), glm::dvec3(centre.x, centre.y, box.low.z - distance));
    return camera;
}

} // namespace parhelion::mitsuba
