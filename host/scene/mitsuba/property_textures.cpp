// Textures among the parameters of one plugin.
#include "host/scene/mitsuba/properties.h"
#include "host/scene/mitsuba/textures.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion::mitsuba {

bool Properties::has_texture(std::string_view name) const {
    return std::any_of(object_.children.begin(), object_.children.end(),
                       [&](const Child& child) { return is_texture(child, name); });
}

bool Properties::is_texture(const Child& child, std::string_view name) const {
    return child.name == name && target(child).tag == "texture";
}

const Object* Properties::take_texture(std::string_view name) {
    const Child* found = nullptr;
    for (const Child& child : object_.children) {
        if (!is_texture(child, name)) continue;
        // `take` says so.
        if (document_.lenient && !is_known_texture(target(child))) continue;
        if (found || find(name))
            refuse(child.location,
                   fmt::format("{}: parameter {} is given twice", title(), in_quotes(name)));
        found = &child;
    }
    if (!found) return nullptr;
    asked_.emplace_back(name);
    known_.emplace_back(name);
    textures_.emplace_back(name);
    return &target(*found);
}

/// A texture that is the same everywhere has been told apart before.
TextureUse Properties::texture_use(std::string_view name, const Object& texture) {
    return {std::make_shared<const Texture>(read_texture(document_, texture, notes_)),
            texture.location, fmt::format("{}: parameter {}", title(), in_quotes(name)),
            domain(name)};
}

Textured<Rgb> Properties::textured_color(std::string_view name, const Textured<Rgb>& missing,
                                         SpectrumUse use) {
    const Object* const texture = take_texture(name);
    if (!texture) return color(name, missing.constant, use, color_or_texture);
    if (const auto same = read_constant_texture(document_, *texture, notes_))
        return Rgb(checked(name, same->r), checked(name, same->g), checked(name, same->b));
    return Textured<Rgb>(texture_use(name, *texture));
}

Textured<double> Properties::textured_number(std::string_view name,
                                             const Textured<double>& missing) {
    const Object* const texture = take_texture(name);
    if (!texture) return number(name, missing.constant, "<float>, <texture>");
    if (const auto same = read_constant_texture(document_, *texture, notes_))
        return checked(name, luminance(*same));
    return Textured<double>(texture_use(name, *texture));
}

TextureUse Properties::only_bitmap() {
    const std::vector<const Child*> textures = children("texture");
    if (textures.size() != 1)
        refuse_at(location(),
                  fmt::format("{} holds {} textures (accepted: 1)", title(), textures.size()));
    const Object& texture = target(*textures.front());
    if (texture.plugin != "bitmap")
        refuse_at(textures.front()->location,
                  fmt::format("{} cannot hold the texture plugin {} (accepted: bitmap)", title(),
                              in_quotes(texture.plugin)));
    return {std::make_shared<const Texture>(read_texture(document_, texture, notes_)),
            textures.front()->location, title() + ": its texture", any_number()};
}

} // namespace parhelion::mitsuba
