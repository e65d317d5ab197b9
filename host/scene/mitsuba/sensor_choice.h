// Which of a file's sensors is used, and what is seen where it has none.
#pragma once

#include "host/scene/camera.h"
#include "host/scene/mitsuba/document.h"
#include "host/scene/shape.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion::mitsuba {

/// Their ids, or "sensor 0" and so on of those without.
std::vector<std::string> sensor_names(const Document& document,
                                      const std::vector<const Child*>& sensors);

/// The index of the one that is `wanted`, else of the first, with a note where there are others or
/// none at all. Throws InputError for one that is not there.
std::size_t chosen_sensor(const std::vector<std::string>& names, std::optional<int> wanted,
                          const std::string& file, std::vector<std::string>& notes);

/// Mitsuba 2's camera of scenes without one: 45 degrees wide, it looks along +z at the middle of
/// all shapes, from as far before them as makes the largest extent of their box fill its view.
Camera default_view(const std::vector<Shape>& shapes);

} // namespace parhelion::mitsuba
