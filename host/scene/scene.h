// The scene as its author wrote it: host types, double precision, names and places kept for
// messages.
//
// Geometry is in world space (transforms are already applied); nothing here knows about devices or
// kernels.
#pragma once

#include "host/error.h"
#include "host/scene/parameter.h"
#include "kernels/shared/materials.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace parhelion {

// ----------------------------------------------------------------------------------------------
// materials, from the lists in kernels/shared/materials.h

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

// ----------------------------------------------------------------------------------------------
// shapes

/// Triangles with shared vertices. `normals` and `uvs` are empty or as long as `positions`.
/// `flip_normals` is applied on loading (winding and vertex normals), `face_normals` drops the
/// vertex normals.
struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals; ///< unit length
    std::vector<glm::dvec2> uvs;
    std::vector<glm::uvec3>
        triangles; ///< counter-clockwise seen from the side the geometric normal points to
};

/// Analytic sphere. The axes (unit, orthogonal, right-handed up to a mirror) carry the uv
/// parametrisation.
struct Sphere {
    glm::dvec3 center{0.0};
    double radius = 1.0;
    glm::dvec3 axis_x{1, 0, 0}, axis_y{0, 1, 0}, axis_z{0, 0, 1};
    bool flip_normals = false; ///< the normal points to the centre
};

/// Analytic disk { center + a*edge_u + b*edge_v : a^2 + b^2 <= 1 }; an ellipse where the edges are
/// not orthogonal and equally long. The normal is along cross(edge_u, edge_v), reversed by
/// `flip_normals`.
struct Disk {
    glm::dvec3 center{0.0};
    glm::dvec3 edge_u{1, 0, 0}, edge_v{0, 1, 0};
    bool flip_normals = false;
};

using Geometry = std::variant<Mesh, Sphere, Disk>;

inline constexpr int no_material = -1;

struct Shape {
    std::string id;
    std::string plugin; ///< "obj", "sphere", ...
    SourceLocation location;
    Geometry geometry;
    int material_front =
        no_material; ///< index into Scene::materials; the side the normal points to
    /// The other side. `twosided` gives it a material; otherwise equal to material_front for BSDFs
    /// that look at both sides themselves (dielectrics, null) and `no_material` (black) for the
    /// rest.
    int material_back = no_material;
    std::optional<Rgb> radiance; ///< area emitter on the front side, W/(m^2 sr)
};

// ----------------------------------------------------------------------------------------------
// emitters

struct PointEmitter {
    glm::dvec3 position{0.0};
    Rgb intensity{1.0}; ///< W/sr
};

/// Full intensity inside `beam_width`, falling linearly in angle to zero at `cutoff_angle` (both
/// half angles, radians).
struct SpotEmitter {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0, 0, 1}; ///< unit, the axis of the cone
    double cutoff_angle = 0.349066;
    double beam_width = 0.261799;
    Rgb intensity{1.0}; ///< W/sr on the axis
};

struct DirectionalEmitter {
    glm::dvec3 direction{0, 0, 1}; ///< unit, the way the light travels
    Rgb irradiance{1.0};           ///< W/m^2 on a surface facing it
};

struct ConstantEmitter {
    Rgb radiance{1.0}; ///< W/(m^2 sr) from every direction
};

using Emitter = std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, ConstantEmitter>;

// ----------------------------------------------------------------------------------------------
// sensor and film

enum class FovAxis { x, y, diagonal, smaller, larger };

/// Pinhole or thin-lens camera. Camera space: looks along +z, +y is up, +x is to the LEFT of the
/// image (Mitsuba's convention: to_world is a rotation and translation, in rare files with a
/// mirror, and image x runs along camera -x).
struct Camera {
    glm::dmat4 to_world{1.0};
    std::optional<double>
        fov_degrees; ///< full angle along fov_axis; absent when focal_length_mm is given
    std::optional<double>
        focal_length_mm; ///< of a 35 mm film (24 mm x 36 mm: full diagonal 43.27 mm)
    FovAxis fov_axis = FovAxis::x;
    double near_clip = 1e-2, far_clip = 1e4; ///< distances along the optical axis, world units
    glm::dvec2 principal_point_offset{0.0};  ///< in fractions of the film width and height
    double aperture_radius = 0.0;            ///< 0 for a pinhole
    double focus_distance = 1.0;
};

enum class PixelFormat { luminance, luminance_alpha, rgb, rgba, xyz, xyza };
enum class ComponentFormat { float16, float32, uint32 };

#define FILTER_KINDS(X) X(box) X(tent) X(gaussian) X(mitchell) X(catmullrom) X(lanczos)
#define FILTER_KIND_ENUM(name) name,
enum class FilterKind { FILTER_KINDS(FILTER_KIND_ENUM) };

/// Separable reconstruction filter; the parameters a kind does not have are unused.
struct ReconstructionFilter {
    FilterKind kind = FilterKind::gaussian;
    double radius = 0.0; ///< tent; 0: the kind's default
    double stddev = 0.5; ///< gaussian, pixels
    double mitchell_a = 1.0 / 3.0,
           mitchell_b = 1.0 / 3.0; ///< Mitchell and Netravali's B and C, named so in the file
    int lanczos_lobes = 3;
};

/// How a filter wider than a pixel is applied: a sample counts for every pixel that the filter
/// reaches, or it lies where the filter has put it and counts for one pixel alone.
#define FILTER_METHODS(X) X(splatting) X(sampling)
#define METHOD_ENUM(name) name,
enum class FilterMethod { FILTER_METHODS(METHOD_ENUM) };

struct Film {
    int width = 768, height = 576;
    int crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0; ///< 0 x 0: the whole film
    PixelFormat pixel_format = PixelFormat::rgb;
    ComponentFormat component_format = ComponentFormat::float32;
    bool sample_border = false; ///< the filter also reaches for light beyond the edge of the film
    ReconstructionFilter filter;
    FilterMethod filter_method = FilterMethod::splatting;
};

enum class IntegratorKind { path, direct, depth, normals, aov };

/// An AOV asked for by the scene: the name its channels get and the kind, e.g. {"nn", "sh_normal"}.
struct AovRequest {
    std::string name;
    std::string kind;
    SourceLocation location;
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
};

/// How the samples of a pixel lie: Owen-scrambled points of a low-discrepancy sequence, or
/// independent random numbers.
#define SAMPLE_PATTERNS(X) X(faure) X(independent)
#define PATTERN_ENUM(name) name,
enum class SamplePattern { SAMPLE_PATTERNS(PATTERN_ENUM) };
#define PATTERN_NAME(name) #name,
inline constexpr std::array sample_pattern_names{SAMPLE_PATTERNS(PATTERN_NAME)};

struct Sampler {
    std::string plugin =
        "independent"; ///< as written; the pattern does not follow it (see Scene::notes)
    SamplePattern pattern = SamplePattern::faure;
    int samples_per_pixel = 16;
    int replicates = 1; ///< independently scrambled patterns that take turns, a power of two
    std::uint32_t seed = 0;
};

// ----------------------------------------------------------------------------------------------
// scene

struct Scene {
    std::string file;
    std::vector<std::string> files; ///< that it was read from beside that one
    std::vector<Material> materials;
    std::vector<Shape> shapes;
    std::vector<Emitter> emitters; ///< all but area emitters, which stand with their shapes
    Camera camera;
    Film film;
    Integrator integrator;
    Sampler sampler;
    std::vector<std::string>
        notes; ///< what was mapped or defaulted and the user should be told, one line each
};

} // namespace parhelion
