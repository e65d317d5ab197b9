// What the AOVs of an image with one sample a pixel say of the first hits: of one sample every
// value belongs to one point, so that it has a closed form. Rendered by the kernels compiled as
// C++.
#pragma once

#include "host/commands/render.h"
#include "host/render/host_render.h"
#include "host/scene/load.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <string>
#include <vector>

namespace parhelion::test {

struct FirstHit {
    int x = 0, y = 0; ///< pixel of the full film
    bool hit = false;
    double alpha = 0;
    glm::dvec3 p{}, ng{}, ns{}, albedo{};
    glm::dvec2 uv{};
    double depth = 0;
    int shape = 0, primitive = 0;
};

/// An integrator that asks for every AOV of the kernels, by short names.
inline const std::string every_aov =
    "<integrator type=\"aov\"><string name=\"aovs\" value=\"al:albedo, dd:depth, pp:position, "
    "tex:uv, ng:geo_normal, ns:sh_normal, prim:prim_index, shape:shape_index\"/></integrator>\n";

/// Shapes before a camera that looks along -z, image x to the world's +x and y to its -y.
inline std::string looking_down(double distance, const std::string& sensor,
                                const std::string& film) {
    return "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"0,0," +
           std::to_string(distance) + "\" target=\"0,0,0\" up=\"0,1,0\"/></transform>" + sensor +
           "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"1\"/></sampler>"
           "<film type=\"hdrfilm\"><string name=\"pixel_format\" value=\"rgba\"/>" +
           film + "</film></sensor>\n";
}

/// `body`: everything of a scene. The crop is resolved, as the command does.
inline Scene scene_of_text(const std::string& body) {
    const SceneFolder folder;
    Scene scene =
        load_scene(folder.write("scene.xml", "<scene version=\"3.0.0\">" + body + "</scene>"));
    apply_overrides({}, scene);
    return scene;
}

inline Image host_image(const Scene& scene) {
    Progress quiet(Progress::Mode::quiet);
    RenderResult result = render_on_host(scene, {}, Precision::single_precision, quiet);
    CHECK(result.report.non_finite_samples == 0);
    return result.image;
}

inline double value_at(const Image& image, const std::string& channel, std::size_t i) {
    const Channel* found = find_channel(image, channel);
    INFO(channel);
    REQUIRE(found);
    return found->values[i];
}

inline glm::dvec3 triple_at(const Image& image, const std::string& layer, const char* suffixes,
                            std::size_t i) {
    glm::dvec3 v;
    for (int c = 0; c < 3; c++)
        v[c] = value_at(image, layer + "." + suffixes[c], i);
    return v;
}

/// Of a scene with `every_aov`.
inline std::vector<FirstHit> first_hits(const Scene& scene) {
    Image image = host_image(scene);
    std::vector<FirstHit> hits;
    for (std::size_t i = 0; i < image.pixel_count(); i++) {
        FirstHit h;
        h.x = image.offset_x + static_cast<int>(i) % image.width;
        h.y = image.offset_y + static_cast<int>(i) / image.width;
        h.alpha = value_at(image, "A", i);
        h.p = triple_at(image, "pp", "XYZ", i);
        h.ng = triple_at(image, "ng", "XYZ", i), h.ns = triple_at(image, "ns", "XYZ", i);
        h.albedo = triple_at(image, "al", "RGB", i);
        h.uv = {value_at(image, "tex.U", i), value_at(image, "tex.V", i)};
        h.depth = value_at(image, "dd.T", i);
        h.shape = static_cast<int>(value_at(image, "shape.I", i));
        h.primitive = static_cast<int>(value_at(image, "prim.I", i));
        h.hit = glm::dot(h.ng, h.ng) > 0;
        hits.push_back(h);
    }
    return hits;
}

/// CHECKs that two vectors are the same to `margin`.
inline void check_near(const glm::dvec3& found, const glm::dvec3& expected, double margin) {
    INFO("found " << found.x << " " << found.y << " " << found.z << ", expected " << expected.x
                  << " " << expected.y << " " << expected.z);
    CHECK(glm::length(found - expected) <= margin);
}

} // namespace parhelion::test
