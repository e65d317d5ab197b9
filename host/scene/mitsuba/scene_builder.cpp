// From a Mitsuba document to a Scene.
#include "host/scene/mitsuba/scene_builder.h"

#include "host/scene/material_textures.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"
#include "host/scene/mitsuba/sensor_choice.h"
#include "host/scene/mitsuba/textures.h"
#include "host/scene/mitsuba/xml_file.h"
#include "host/scene/text.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace parhelion::mitsuba {

namespace {

class SceneBuilder {
public:
    SceneBuilder(Document document, const LoadOptions& options)
        : document_(std::move(document)), wanted_sensor_(options.sensor) {
        scene_.notes = std::move(document_.notes);
        problems_ = std::move(document_.problems);
    }

    Scene build(const std::string& file);

private:
    /// Keeps what is refused; where the document is read leniently, an unknown plugin is left out
    /// with a note.
    template<typename Act>
    void attempt(const Act& act) {
        problems_.attempt([&] {
            try {
                act();
            } catch (const NotKnown& unknown) {
                if (!document_.lenient) throw;
                scene_.notes.push_back(std::string(unknown.what()) + ": left out");
            }
        });
    }
    void add(const Child& child);
    void check_definition(const Child& child, const Object& object);
    void add_shape(const Object& object);
    void add_emitter(const Object& object);
    void set_sensor(const std::string& file);
    void note_fault_of(const Object& sensor);
    void set_integrator(const Child& child);
    SurfaceMaterials materials_of(const Object& object);
    SurfaceMaterials default_material(bool emits);

    Document document_;
    Scene scene_;
    std::map<const Object*, SurfaceMaterials> materials_; ///< by the bsdf that asked for them
    std::map<bool, SurfaceMaterials> default_materials_;
    std::vector<const Child*> sensors_;
    std::optional<int> wanted_sensor_;
    std::optional<SourceLocation> integrator_, background_;
    Problems problems_;
};

SurfaceMaterials SceneBuilder::materials_of(const Object& object) {
    const auto [entry, added] = materials_.try_emplace(&object);
    if (added) entry->second = read_bsdf(document_, object, scene_, scene_.notes);
    return entry->second;
}

/// What Mitsuba gives a shape without a bsdf: grey, or black where it emits.
SurfaceMaterials SceneBuilder::default_material(bool emits) {
    const auto [entry, added] = default_materials_.try_emplace(emits);
    if (added)
        entry->second.front = add_material(scene_, {emits ? "default of emitters" : "default",
                                                    {scene_.file, 0},
                                                    DiffuseBsdf{Rgb(emits ? 0.0 : 0.5)}});
    return entry->second;
}

/// A texture tells it in the place of 1.
static void set_radiance(Shape& shape, const Textured<Rgb>& radiance) {
    shape.radiance = radiance.texture ? Rgb(1.0) : radiance.constant;
    shape.radiance_texture = radiance.texture;
}

void SceneBuilder::add_shape(const Object& object) {
    Shape shape{object.id, object.plugin, object.location, {}, {}, {}, {}};
    if (shape.id.empty()) shape.id = "shape " + std::to_string(scene_.shapes.size() + 1);
    ShapeParts parts = shape_parts(document_, object);
    shape.bsdf_id = !parts.bsdf ? "default" : parts.bsdf->id;
    if (shape.bsdf_id.empty()) shape.bsdf_id = shape.id + ".bsdf";
    bool there = false;
    attempt([&] {
        shape.geometry = read_shape(document_, object, scene_.notes);
        there = true;
    });
    attempt([&] {
        if (!parts.emitter) return;
        set_radiance(shape, read_area_emitter(document_, *parts.emitter, scene_.notes));
        shape.emitter_id = parts.emitter->id;
    });
    problems_.attempt([&] {
        const SurfaceMaterials materials =
            parts.bsdf ? materials_of(*parts.bsdf) : default_material(parts.emitter != nullptr);
        shape.material_front = materials.front;
        shape.material_back = materials.back;
    });
    if (there) scene_.shapes.push_back(std::move(shape));
}

void SceneBuilder::add_emitter(const Object& object) {
    if (object.plugin == "area" && !object.id.empty()) { // for a shape to refer to
        static_cast<void>(read_area_emitter(document_, object, scene_.notes));
        return;
    }
    const Emitter emitter = read_emitter(document_, object, scene_.notes);
    if (is_sky(emitter)) {
        if (background_)
            refuse(object.location, "a second emitter around the whole scene (the first: " +
                                        background_->to_string() + "; accepted: one)");
        background_ = object.location;
    }
    scene_.emitters.push_back(emitter);
    scene_.emitter_ids.push_back(object.id);
}

void refuse_second(std::optional<SourceLocation>& first, const Child& child, const char* tag) {
    if (first)
        refuse(child.location, std::string("a second <") + tag +
                                   "> (the first: " + first->to_string() + "; accepted: one)");
    first = child.location;
}

/// What --sensor chooses, or the first; without any in the file a view of all shapes.
void SceneBuilder::set_sensor(const std::string& file) {
    scene_.sensors = sensor_names(document_, sensors_);
    const std::size_t index = chosen_sensor(scene_.sensors, wanted_sensor_, file, scene_.notes);
    if (sensors_.empty()) {
        scene_.camera = default_view(scene_.shapes);
        scene_.film.pixel_format = PixelFormat::rgb;
        scene_.sampler.samples_per_pixel = default_samples;
        return;
    }
    SensorParts parts =
        read_sensor(document_, document_.objects[sensors_[index]->object], scene_.notes);
    scene_.camera = parts.camera;
    scene_.film = parts.film;
    scene_.sampler = std::move(parts.sampler);
    for (const Child* const other : sensors_)
        if (other != sensors_[index]) note_fault_of(document_.objects[other->object]);
}

/// What another sensor has wrong changes nothing in this picture.
void SceneBuilder::note_fault_of(const Object& sensor) {
    const auto note = [&](std::string_view line) {
        scene_.notes.push_back(std::string(line) + ": it is not the chosen sensor");
    };
    std::vector<std::string> of_other;
    try {
        static_cast<void>(read_sensor(document_, sensor, of_other));
    } catch (const InputError& error) {
        for (const std::string_view line : split(error.what(), "\n"))
            note(line);
        return;
    }
    if (document_.lenient)
        for (const std::string& line : of_other)
            note(line);
}

void SceneBuilder::set_integrator(const Child& child) {
    refuse_second(integrator_, child, "integrator");
    scene_.integrator = read_integrator(document_, document_.objects[child.object], scene_.notes);
}

void SceneBuilder::add(const Child& child) {
    const Object& object = document_.objects[child.object];
    if (object.tag == "shape")
        add_shape(object);
    else if (object.tag == "emitter")
        add_emitter(object);
    else if (object.tag == "sensor")
        sensors_.push_back(&child);
    else if (object.tag == "integrator")
        set_integrator(child);
    else
        check_definition(child, object);
}

/// What stands in the scene only to be referred to. It is read even if nothing does, so that its
/// mistakes are found.
void SceneBuilder::check_definition(const Child& child, const Object& object) {
    if (object.tag == "bsdf") {
        Scene unused;
        read_bsdf(document_, object, unused, scene_.notes);
    } else if (object.tag == "film")
        static_cast<void>(read_film(document_, object, scene_.notes));
    else if (object.tag == "rfilter")
        static_cast<void>(read_filter(document_, object, scene_.notes));
    else if (object.tag == "sampler")
        static_cast<void>(read_sampler(document_, object, scene_.notes));
    else if (object.tag == "texture")
        check_texture(document_, object, scene_.notes);
    else
        throw NotKnown(child.location.to_string() + ": " + object.tag + " plugin " +
                       in_quotes(object.plugin) +
                       " is not supported (<scene> holds bsdf, emitter, integrator, "
                       "sensor, shape)");
}

/// An empty mesh among others is noted by its reader; a scene of nothing else is a mistake, which
/// what was noted of the first explains.
void refuse_only_empty(const Scene& scene) {
    const auto is_empty = [](const Shape& shape) {
        const Mesh* const mesh = std::get_if<Mesh>(&shape.geometry);
        return mesh && mesh->triangles.empty();
    };
    if (scene.shapes.empty() || !std::all_of(scene.shapes.begin(), scene.shapes.end(), is_empty))
        return;
    const SourceLocation& place = scene.shapes[0].location;
    const std::string start = place.to_string() + ": ";
    std::string reasons;
    for (const std::string& note : scene.notes)
        if (note.starts_with(start))
            reasons += (reasons.empty() ? "" : "; ") + note.substr(start.size());
    refuse(place, reasons);
}

/// What no texture names is of no use: scanned meshes have colours that cost as much as their
/// points.
void drop_unread_attributes(Scene& scene) {
    std::set<std::string> read;
    const auto reads = [&](const TextureUse& use) {
        if (!use) return;
        const auto* const a = std::get_if<MeshAttributeTexture>(&use.texture->kind);
        if (a) read.insert(a->name);
    };
    for (const Material& material : scene.materials)
        each_texture(material.bsdf, reads);
    for (const Blend& blend : scene.blends)
        reads(blend.weight.texture);
    for (const Shape& shape : scene.shapes)
        reads(shape.radiance_texture);
    for (Shape& shape : scene.shapes) {
        Mesh* const mesh = std::get_if<Mesh>(&shape.geometry);
        if (!mesh) continue;
        std::erase_if(mesh->attributes, [&](const MeshAttribute& a) {
            if (read.contains(a.name)) return false;
            scene.notes.push_back(shape.location.to_string() + ": attribute " + in_quotes(a.name) +
                                  " of the mesh is not used");
            return true;
        });
    }
}

Scene SceneBuilder::build(const std::string& file) {
    scene_.file = file;
    const Object& root = document_.objects.front();
    for (const Child& child : root.children)
        attempt([&] { add(child); });
    for (const Parameter& parameter : root.parameters)
        problems_.attempt([&] {
            refuse(parameter.location, "<scene> has no parameter " + in_quotes(parameter.spelling));
        });
    problems_.attempt([&] { set_sensor(file); });
    problems_.throw_if_any();
    refuse_only_empty(scene_);
    drop_unread_attributes(scene_);
    if (!integrator_)
        scene_.notes.push_back(file + ": the scene has no <integrator>; \"path\" is used");
    scene_.files = document_.files.found();
    // Names and values out of files can neither break a line nor tell a terminal what to do.
    for (std::string& note : scene_.notes)
        note = as_one_line(std::move(note));
    return std::move(scene_);
}

} // namespace

Scene load_xml_scene(const std::string& file, const LoadOptions& options) {
    return parse_xml_scene(read_xml_file(file, {file, 0}), options);
}

Scene parse_xml_scene(const XmlFile& xml, const LoadOptions& options) {
    return SceneBuilder(read_document(xml, options), options).build(xml.name());
}

} // namespace parhelion::mitsuba
