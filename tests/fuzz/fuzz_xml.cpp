// Mitsuba scenes, in a folder of few small files that they may name.
#include "host/scene/mitsuba/scene_builder.h"
#include "host/scene/mitsuba/xml_file.h"
#include "property.h"
#include "targets.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace parhelion::fuzz {

namespace {

namespace fs = std::filesystem;

/// What a scene may name; the folder lives as long as the process.
class SceneFolder {
public:
    SceneFolder() {
        std::string name = (fs::temp_directory_path() / "parhelion_fuzz_XXXXXX").string();
        promise(mkdtemp(name.data()) != nullptr, "a temporary folder can be made");
        path_ = name;
        write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write("a.spd", "400 1\n700 0.5\n");
        write("a.xml", "<bsdf version='3.0.0' type='diffuse' id='a'/>");
        write("b.xml", "<scene version='1.0.0'><include filename='b.xml'/></scene>");
        fs::create_directory(path_ / "d");
        write("d/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 2\nf 1//1 2//1 3//1\n");
    }
    ~SceneFolder() { fs::remove_all(path_); }
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    std::string scene_name() const { return (path_ / "scene.xml").string(); }

private:
    void write(const char* name, const char* content) const {
        std::ofstream(path_ / name) << content;
    }
    fs::path path_;
};

/// A part of a blend is one that stands before it.
void check_side(const Scene& scene, int code, std::size_t blends) {
    if (!IS_BLEND(code)) {
        promise(code == no_material ||
                    (code >= 0 && static_cast<std::size_t>(code) < scene.materials.size()),
                "a shape uses a material that is not there");
        return;
    }
    const auto number = static_cast<std::size_t>(BLEND_NUMBER(code));
    promise(number < blends, "a side is made of a blend that is not there");
    const Blend& blend = scene.blends[number];
    const double weight = blend.weight.constant;
    promise(blend.weight.texture || (weight > 0.0 && weight < 1.0), "each of a blend has a share");
    for (const int part : {blend.first, blend.second}) {
        promise(part != no_material, "a blend has nothing that is no material");
        check_side(scene, part, number);
    }
}

/// What tables are asked for lies in them.
void check_sun(const SunskyEmitter& e) {
    promise(std::abs(glm::length(e.sun) - 1.0) < 1e-6, "the sun stands somewhere");
    promise(e.turbidity >= 1.0 && e.turbidity <= 10.0, "air is as clear as tables know it");
    promise(e.half_aperture > 0.0 && e.half_aperture < 1.5708, "the sun is a disk");
    for (int color = 0; color < 3; color++)
        promise(e.albedo[color] >= 0.0 && e.albedo[color] <= 1.0, "the ground reflects a share");
}

void check_scene(const Scene& scene) {
    for (const Shape& shape : scene.shapes) {
        if (const Mesh* const mesh = std::get_if<Mesh>(&shape.geometry)) check_mesh(*mesh);
        for (const int side : {shape.material_front, shape.material_back})
            check_side(scene, side, scene.blends.size());
    }
    for (const Emitter& emitter : scene.emitters)
        if (const auto* const daylight = std::get_if<SunskyEmitter>(&emitter)) check_sun(*daylight);
    promise(scene.film.width > 0 && scene.film.height > 0, "the film has pixels");
    promise(scene.sampler.samples_per_pixel > 0, "there are samples");
    for (const std::string& note : scene.notes)
        check_message(note);
}

} // namespace

int fuzz_xml(const std::uint8_t* data, std::size_t size) {
    static const SceneFolder folder;
    return answer_or_refusal([&] {
        const mitsuba::XmlFile xml(folder.scene_name(), std::string(as_text(data, size)));
        check_scene(mitsuba::parse_xml_scene(xml, {}));
    });
}

} // namespace parhelion::fuzz
