// The texture plugins.
#pragma once

#include "host/scene/mitsuba/document.h"
#include "host/scene/texture.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion::mitsuba {

/// Of linear sRGB, as Mitsuba weighs it: the number that a colour is where one is wanted.
double luminance(const Rgb& color);

class Properties;

/// The image in the file that a parameter names: its header is read, its texels are not. Throws
/// InputError at the parameter.
TexelSource read_image(Properties& p, std::string_view name);

bool is_known_texture(const Object& object);

/// A texture that is not the same everywhere. An image's header is read, its texels are not. Throws
/// InputError.
Texture read_texture(const Document& document, const Object& object,
                     std::vector<std::string>& notes);

/// The value of a texture that is the same everywhere; nothing for another.
std::optional<Rgb> read_constant_texture(const Document& document, const Object& object,
                                         std::vector<std::string>& notes);

/// Of one that nothing refers to.
void check_texture(const Document& document, const Object& object, std::vector<std::string>& notes);

} // namespace parhelion::mitsuba
