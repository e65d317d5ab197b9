// How the picture of a film is written as an .exr, as `render` and `merge` are asked to.
#pragma once

#include "host/commands/command_line.h"
#include "host/film/film_content.h"
#include "host/image/write_image.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// What the command line says of it. It has no say in what is on the film.
struct PictureForm {
    std::optional<std::string> compression{};
    std::vector<std::string> layer_formats{}; ///< NAME=half or NAME=float

    bool asked() const { return compression || !layer_formats.empty(); }
};

/// What users call the layer without a name.
inline constexpr const char* main_layer_name = "image";

/// Whether a name is that of a film, by its extension.
bool is_film_file(const std::string& file);

/// The rows of it in a subcommand's table.
std::vector<Option> picture_form_options(PictureForm& form);

/// Throws InputError for words that are not known, or where `output` is no .exr.
void check_picture_form(const PictureForm& form, const std::string& output);

/// For the picture of such a film. Layers of whole numbers are float32 where they would be float16,
/// which has those up to 2048 alone. Throws InputError for a layer that there is not, that is named
/// twice, or whose whole numbers the file would not hold.
ExrOptions exr_options(const PictureForm& form, const FilmContent& content);
/// The same, with what is said of previews and of files that exist.
WriteOptions write_options(const PictureForm& form, const FilmContent& content,
                           std::optional<double> exposure, Existing existing);

} // namespace parhelion
