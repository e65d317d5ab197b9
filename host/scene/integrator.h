// The integrator: what is asked of light, and which values beside the radiance.
#pragma once

#include "host/error.h"

#include <array>
#include <string>
#include <vector>

namespace parhelion {

#define INTEGRATORS(X) X(path) X(direct) X(normals) X(depth) X(aov)
#define INTEGRATOR_ENUM(name) name,
enum class IntegratorKind { INTEGRATORS(INTEGRATOR_ENUM) };
#define INTEGRATOR_NAME(name) #name,
inline constexpr std::array integrator_names{INTEGRATORS(INTEGRATOR_NAME)};

/// An AOV asked for by the scene: the name its channels get and the kind, e.g. {"nn", "sh_normal"}.
struct AovRequest {
    std::string name;
    std::string kind;
    SourceLocation location;
};

/// Emitters whose light is a layer by itself. One without ids: all that are in no other.
struct LightGroup {
    std::string name;
    std::vector<std::string> ids; ///< of emitters, or of the shapes that they are on
};

/// What of the shapes of a pixel are told apart: as Cryptomatte layers.
struct CryptomatteRequest {
    bool objects = false, materials = false; ///< by ids of shapes, of their bsdfs
    int depth = 6;                           ///< of a pixel, at most

    bool asked() const { return objects || materials; }
};

/// `consistent`: shading of smooth meshes keeps to their geometry
/// (kernels/shared/shading_normal.h); `soft`: and diffuse light fades towards the true horizon,
/// which hides the edges of faces and loses light; `raw`: interpolated normals are taken as they
/// are.
#define SHADING_NORMALS(X) X(consistent) X(soft) X(raw)
#define SHADING_NORMALS_ENUM(name) name,
enum class ShadingNormals { SHADING_NORMALS(SHADING_NORMALS_ENUM) };
#define SHADING_NORMALS_NAME(name) #name,
inline constexpr std::array shading_normals_names{SHADING_NORMALS(SHADING_NORMALS_NAME)};

struct Integrator {
    IntegratorKind kind = IntegratorKind::path;
    int max_depth =
        -1; ///< in edges from the camera: 1 shows emitters only, 2 direct light; -1 no limit
    int rr_depth = 5; ///< Russian roulette starts after this many vertices
    bool hide_emitters = false;
    ShadingNormals shading_normals = ShadingNormals::consistent;
    bool second_moment = false; ///< wrapped in `moment`: also store the mean of the squared
                                ///< radiance. What follows from it is the variance of one sample; a
                                ///< mean of n in the pattern has less than an n-th of it.
    bool emitter_samples = true,
         bsdf_samples = true; ///< `direct`: which of the two strategies are used
    std::vector<AovRequest> aovs;
    CryptomatteRequest cryptomatte;
    std::vector<LightGroup> light_groups; ///< none, or each emitter is in one
};

} // namespace parhelion
