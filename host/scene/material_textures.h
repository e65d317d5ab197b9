// Which parameters of a material are textures.
#pragma once

#include "host/scene/material.h"

#include <variant>

namespace parhelion {

template<class Visit>
void visit_textures(double, const Visit&) {}
template<class Visit>
void visit_textures(const parameter::EvenRoughness::Value&, const Visit&) {}
template<class T, class Visit>
void visit_textures(const Textured<T>& value, const Visit& visit) {
    if (value.texture) visit(value.texture);
}
template<class Visit>
void visit_textures(const parameter::ComplexIndex::Value& index, const Visit& visit) {
    visit_textures(index.eta, visit);
    visit_textures(index.k, visit);
}
template<class Roughness, class Visit>
requires requires(const Roughness& r) {
    r.alpha_u;
    r.alpha_v;
}
void visit_textures(const Roughness& roughness, const Visit& visit) {
    visit_textures(roughness.alpha_u, visit);
    visit_textures(roughness.alpha_v, visit);
}

#define VISIT_TEXTURES(Kind, name, ...) visit_textures(b.name, visit);
#define VISIT_TEXTURES_OF(name, Name, ...)                                                         \
    template<class Visit>                                                                          \
    void visit_textures_of([[maybe_unused]] const Name##Bsdf& b,                                   \
                           [[maybe_unused]] const Visit& visit) {                                  \
        PARAMETERS_##name(VISIT_TEXTURES)                                                          \
    }
MATERIALS(VISIT_TEXTURES_OF)
#undef VISIT_TEXTURES_OF
#undef VISIT_TEXTURES

/// visit(TextureUse) for each parameter that is a texture.
template<class Visit>
void each_texture(const Bsdf& bsdf, const Visit& visit) {
    std::visit([&](const auto& b) { visit_textures_of(b, visit); }, bsdf);
}

} // namespace parhelion
