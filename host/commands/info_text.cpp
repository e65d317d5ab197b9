// What `parhelion info` prints for people: a title and lines with labels.
#include "host/commands/info_text.h"

#include "host/scene/film.h"

#include <nlohmann/json.hpp>

namespace parhelion {

nlohmann::json film_size_json(const Film& film) {
    return {{"width_pixels", film.width},
            {"height_pixels", film.height},
            {"crop",
             {{"x", film.crop_x},
              {"y", film.crop_y},
              {"width_pixels", film.crop_width},
              {"height_pixels", film.crop_height}}}};
}

std::string film_size_text(const nlohmann::json& size, int samples_per_pixel) {
    const nlohmann::json& crop = size["crop"];
    const auto number = [](const nlohmann::json& n) { return n.get<int>(); };
    std::string text =
        fmt::format("{} x {} pixels", number(size["width_pixels"]), number(size["height_pixels"]));
    if (crop["width_pixels"] != size["width_pixels"] ||
        crop["height_pixels"] != size["height_pixels"])
        text += fmt::format(", of which {} x {} at {},{}", number(crop["width_pixels"]),
                            number(crop["height_pixels"]), number(crop["x"]), number(crop["y"]));
    return text + fmt::format(", {} spp", samples_per_pixel);
}

} // namespace parhelion
