// Materials as a scene's author wrote them, from the lists in kernels/shared/materials.h.
#pragma once

#include "host/error.h"
#include "host/scene/parameter.h"
#include "kernels/shared/materials.h"

#include <string>
#include <variant>

namespace parhelion {

#define BSDF_MEMBER(Kind, name, missing, ...) parameter::Kind::Value name{missing};
#define BSDF_STRUCT(name, Name, ...)                                                               \
    struct Name##Bsdf {                                                                            \
        PARAMETERS_##name(BSDF_MEMBER)                                                             \
    };
MATERIALS(BSDF_STRUCT)

template<class, class... Kinds>
struct VariantOf {
    using Type = std::variant<Kinds...>;
};
#define BSDF_TYPE(name, Name, ...) , Name##Bsdf
using Bsdf = VariantOf<void MATERIALS(BSDF_TYPE)>::Type; ///< its index is the MaterialKind

struct Material {
    std::string id; ///< the author's id, or a made-up one ("bsdf 3")
    SourceLocation location;
    Bsdf bsdf;
};

} // namespace parhelion
