// The shape plugins.
#include "host/scene/meshes/kept_meshes.h"
#include "host/scene/meshes/mesh_data.h"
#include "host/scene/meshes/mesh_obj.h"
#include "host/scene/meshes/mesh_ply.h"
#include "host/scene/meshes/mesh_serialized.h"
#include "host/scene/mitsuba/leniency.h"
#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"
#include "host/scene/text.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace parhelion::mitsuba {

namespace {

struct ShapeInput {
    Properties& p;
    const Document& document;
    Notes& notes;
};

/// to_world, which must not flatten the shape.
glm::dmat4 read_to_world(Properties& p) {
    const glm::dmat4 to_world = p.transform("to_world");
    const double determinant = glm::determinant(glm::dmat3(to_world));
    if (determinant == 0.0 || !std::isfinite(determinant))
        p.refuse_value("to_world", "a transform without inverse", "one that keeps volumes above 0");
    return to_world;
}

bool is_mirror(const glm::dmat4& to_world) { return glm::determinant(glm::dmat3(to_world)) < 0.0; }

MeshOptions read_mesh_options(Properties& p) {
    return {read_to_world(p), p.boolean("face_normals", false), p.boolean("flip_normals", false)};
}

Geometry read_mesh(const ShapeInput& in, MeshData data, const MeshOptions& options) {
    return make_mesh(std::move(data), options, in.p.location(), in.notes);
}

/// Of load(path, place) of the file that the shape names, or what was kept of that. `how`: it is
/// loaded.
template<class Load>
Geometry read_file(const ShapeInput& in, const std::string& how, const MeshOptions& options,
                   const Load& load) {
    const std::string name = in.p.required_text("filename");
    in.p.check();
    const SourceLocation place = in.p.location_of("filename");
    const std::filesystem::path path =
        named_at(place, [&] { return in.document.files.file(name, place); });
    const auto make = [&] {
        SerializedMesh file = named_at(place, [&] { return SerializedMesh{load(path, place)}; });
        MeshOptions all = options;
        all.face_normals |= file.face_normals;
        MadeMesh made;
        made.mesh = make_mesh(std::move(file.mesh), all, in.p.location(), made.notes);
        return made;
    };
    KeptMeshes* const kept = in.document.meshes;
    MadeMesh made = kept ? kept->mesh(path, mesh_key(how, options, in.p.location()), make) : make();
    in.notes.insert(in.notes.end(), made.notes.begin(), made.notes.end());
    return std::move(made.mesh);
}

Geometry read_obj(const ShapeInput& in) {
    const bool flip_v = in.p.boolean("flip_tex_coords", true);
    return read_file(in, flip_v ? "obj flipped" : "obj", read_mesh_options(in.p),
                     [&](const auto& path, const SourceLocation& place) {
                         return load_obj(path, flip_v, place);
                     });
}

Geometry read_ply(const ShapeInput& in) {
    const bool flip_v = in.p.boolean("flip_tex_coords", false);
    return read_file(in, flip_v ? "ply flipped" : "ply", read_mesh_options(in.p),
                     [&](const auto& path, const SourceLocation& place) {
                         return load_ply(path, flip_v, place);
                     });
}

Geometry read_serialized(const ShapeInput& in) {
    const std::int64_t index = in.p.integer("shape_index", 0);
    return read_file(in, "serialized " + std::to_string(index), read_mesh_options(in.p),
                     [&](const auto& path, const SourceLocation& place) {
                         return load_serialized(path, index, place);
                     });
}

/// A built-in flat-sided mesh. Its normals transform as normals do, so a mirror does not turn it
/// inside out.
Geometry read_flat_mesh(const ShapeInput& in, MeshData data) {
    MeshOptions options = read_mesh_options(in.p);
    options.face_normals = true; // the same as its own vertex normals
    options.flip_normals = options.flip_normals != is_mirror(options.to_world);
    return read_mesh(in, std::move(data), options);
}

/// [-1, 1]^2 in the plane z = 0, facing +z.
Geometry read_rectangle(const ShapeInput& in) {
    MeshData data;
    data.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    data.triangles = {{0, 1, 3}, {2, 3, 1}}; // as in Mitsuba 3, for the prim_index AOV
    return read_flat_mesh(in, std::move(data));
}

/// [-1, 1]^3, facing outwards; every face has the whole texture.
Geometry read_cube(const ShapeInput& in) {
    MeshData data;
    data.positions = {{1, -1, -1}, {1, -1, 1},  {-1, -1, 1},  {-1, -1, -1}, {1, 1, -1},
                      {-1, 1, -1}, {-1, 1, 1},  {1, 1, 1},    {1, -1, -1},  {1, 1, -1},
                      {1, 1, 1},   {1, -1, 1},  {1, -1, 1},   {1, 1, 1},    {-1, 1, 1},
                      {-1, -1, 1}, {-1, -1, 1}, {-1, 1, 1},   {-1, 1, -1},  {-1, -1, -1},
                      {1, 1, -1},  {1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}};
    for (unsigned first = 0; first < 24; first += 4) {
        data.uvs.insert(data.uvs.end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
        data.triangles.emplace_back(first, first + 1, first + 2);
        data.triangles.emplace_back(first + 3, first, first + 2);
    }
    return read_flat_mesh(in, std::move(data));
}

/// The scale of a transform that keeps spheres round; refuses others.
double uniform_scale(Properties& p, const glm::dmat3& m) {
    // Wider than the rounding of rotations written with six digits, narrower than is seen.
    constexpr double tolerance = 1e-4;
    const double scale = (glm::length(m[0]) + glm::length(m[1]) + glm::length(m[2])) / 3.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (!(std::abs(glm::dot(m[i] / scale, m[j] / scale) - (i == j ? 1.0 : 0.0)) <
                  tolerance))
                p.refuse_value("to_world", "a transform that makes the sphere an ellipsoid",
                               "rotation, translation, uniform scale, mirror");
    return scale;
}

Geometry read_sphere(const ShapeInput& in) {
    const glm::dmat4 to_world = read_to_world(in.p);
    const double scale = uniform_scale(in.p, glm::dmat3(to_world));
    Sphere sphere;
    sphere.center = glm::dvec3(to_world * glm::dvec4(in.p.vector("center", glm::dvec3(0.0)), 1.0));
    sphere.radius = scale * in.p.number("radius", 1.0);
    in.p.check();
    if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius) ||
        !std::isfinite(glm::dot(sphere.center, glm::dvec3(1.0))))
        refuse(in.p.location(), in.p.title() + ": to_world takes it out of the range of numbers");
    sphere.axis_x = glm::normalize(glm::dvec3(to_world[0]));
    sphere.axis_y = glm::normalize(glm::dvec3(to_world[1]));
    sphere.axis_z = glm::normalize(glm::dvec3(to_world[2]));
    // A mirror turns Mitsuba's sphere inside out.
    sphere.flip_normals = in.p.boolean("flip_normals", false) != is_mirror(to_world);
    return sphere;
}

Geometry read_disk(const ShapeInput& in) {
    const glm::dmat4 to_world = read_to_world(in.p);
    Disk disk{glm::dvec3(to_world[3]), glm::dvec3(to_world[0]), glm::dvec3(to_world[1]), false};
    // The normal transforms as normals do: along the cross product, or against it in a mirror.
    disk.flip_normals = in.p.boolean("flip_normals", false) != is_mirror(to_world);
    return disk;
}

/// x, y, z of a frame about the unit vector `n` as Mitsuba's cylinder has it (Duff et al. 2017).
glm::dmat3 frame_about(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    return {glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            glm::dvec3(b, sign + n.y * n.y * a, -n.y), n};
}

/// Refuses a transform that makes no round cylinder of one, `m` being where its x, y, z axes go.
void check_round(Properties& p, const glm::dmat3& m) {
    constexpr double tolerance = 1e-4; // as for spheres
    const double x = glm::length(m[0]), y = glm::length(m[1]), z = glm::length(m[2]);
    const auto across = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return std::abs(glm::dot(glm::normalize(a), glm::normalize(b))) < tolerance;
    };
    if (!(std::abs(y / x - 1.0) < tolerance) || !std::isfinite(z) || !across(m[0], m[1]) ||
        !across(m[0], m[2]) || !across(m[1], m[2]))
        p.refuse_value("to_world", "a transform that makes the cylinder oval or oblique",
                       "rotation, translation, scale of all axes or along its own, mirror");
}

Geometry read_cylinder(const ShapeInput& in) {
    Properties& p = in.p;
    const glm::dmat4 to_world = read_to_world(p);
    const glm::dvec3 p0 = p.vector("p0", glm::dvec3(0.0)), p1 = p.vector("p1", {0.0, 0.0, 1.0});
    const double radius = p.number("radius", 1.0), height = glm::length(p1 - p0);
    p.check();
    if (!(height > 0.0)) p.refuse_value("p1", "the same as \"p0\"", "another point");
    glm::dmat3 local = frame_about((p1 - p0) / height);
    local[0] *= radius, local[1] *= radius, local[2] = p1 - p0;
    const glm::dmat3 world = glm::dmat3(to_world) * local;
    check_round(p, world);
    Cylinder cylinder;
    cylinder.base = glm::dvec3(to_world * glm::dvec4(p0, 1.0));
    cylinder.side = world[0];
    cylinder.axis = world[2];
    cylinder.mirrored = is_mirror(to_world);
    cylinder.flip_normals = p.boolean("flip_normals", false);
    return cylinder;
}

using ShapeReader = Geometry (*)(const ShapeInput&);

constexpr PluginTable<ShapeReader, 8> shape_plugins = {{{"obj", read_obj},
                                                        {"ply", read_ply},
                                                        {"serialized", read_serialized},
                                                        {"rectangle", read_rectangle},
                                                        {"cube", read_cube},
                                                        {"sphere", read_sphere},
                                                        {"disk", read_disk},
                                                        {"cylinder", read_cylinder}}};

} // namespace

ShapeParts shape_parts(const Document& document, const Object& object) {
    ShapeParts parts;
    for (const Child& child : object.children) {
        const Object& inner = document.objects[child.object];
        if (inner.tag == "bsdf" && !parts.bsdf) parts.bsdf = &inner;
        if (inner.tag == "emitter" && !parts.emitter) parts.emitter = &inner;
    }
    return parts;
}

Geometry read_shape(const Document& document, const Object& object, Notes& notes) {
    const auto kin = kin_outside(shape_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const ShapeReader read = find_plugin(shape_plugins, known);
    p.only_child("bsdf");
    p.only_child("emitter");
    Geometry geometry = read({p, document, notes});
    p.number("silhouette_sampling_weight", 1.0); // of Mitsuba's derivatives, no part of a picture
    p.finish();
    return geometry;
}

} // namespace parhelion::mitsuba
