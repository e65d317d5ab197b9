// A scene for every number of every plugin, with that number set to what a test wants.
#pragma once

#include "host/scene/mitsuba/number_parameters.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace parhelion::test {

using mitsuba::NumberForm;
using mitsuba::NumberParameter;

/// The element that gives a parameter the value.
inline std::string number_element(const NumberParameter& p, const std::string& value) {
    switch (p.form) {
    case NumberForm::real:
        return fmt::format("<float name='{}' value='{}'/>", p.name, value);
    case NumberForm::whole:
        return fmt::format("<integer name='{}' value='{}'/>", p.name, value);
    case NumberForm::color:
        return fmt::format("<rgb name='{}' value='{}'/>", p.name, value);
    case NumberForm::vector:
        return fmt::format("<point name='{}' x='{}' y='0' z='0.5'/>", p.name, value);
    case NumberForm::text:
        return fmt::format("<string name='{}' value='{}'/>", p.name, value);
    case NumberForm::step:
        break;
    }
    return "";
}

/// The elements of <transform> with the value in one of their places.
inline std::string step_element(std::string_view element, std::string_view name,
                                const std::string& v) {
    if (element == "matrix")
        return fmt::format("<matrix value='1 0 0 {} 0 1 0 0 0 0 1 0 0 0 0 1'/>", v);
    if (element == "lookat") return fmt::format("<lookat origin='0,0,{}' target='0,0,1'/>", v);
    if (name == "angle") return fmt::format("<rotate x='1' angle='{}'/>", v);
    return fmt::format("<{} x='{}' {}/>", element, v, element == "rotate" ? "angle='30'" : "");
}

inline constexpr const char* white_bsdf = "<bsdf type='twosided'><bsdf type='diffuse'><float "
                                          "name='reflectance' value='1'/></bsdf></bsdf>";

/// What a plugin cannot do without, and what belongs to the number.
inline std::string companions(std::string_view plugin, std::string_view name) {
    if (name == "alpha_u") return "<float name='alpha_v' value='0.1'/>";
    if (name == "alpha_v") return "<float name='alpha_u' value='0.1'/>";
    if ((plugin == "plastic" || plugin == "roughplastic") && name != "diffuse_reflectance")
        return "<float name='diffuse_reflectance' value='1'/>";
    if (plugin == "mask") return white_bsdf;
    if (plugin == "blendbsdf") return fmt::format("{0}{0}", white_bsdf);
    if (plugin == "mesh_attribute") return "<string name='name' value='vertex_color'/>";
    if (plugin == "envmap") return "<string name='filename' value='one.pfm'/>"; // of 1
    if (plugin == "aov") return "<string name='aovs' value='d:depth'/>";
    if (plugin == "moment") return "<integrator type='direct'/>";
    if (plugin == "thinlens" && name != "aperture_radius")
        return "<float name='aperture_radius' value='0.1'/>";
    return "";
}

/// Everything that stands in the scene, for each kind of plugin; what a number is of takes the
/// place of the usual one. The usual ones: a unit ball in a sky of radiance 1, filling the image.
struct DomainScene {
    std::string integrator = "<integrator type='path'><integer name='max_depth' value='64'/>"
                             "</integrator>";
    std::string camera = "perspective", camera_numbers = "<float name='fov' value='10'/>";
    std::string film_plugin = "hdrfilm";
    std::string film = "<integer name='width' value='4'/><integer name='height' value='4'/>";
    std::string filter = "<rfilter type='box'/>";
    std::string sampler = "<sampler type='independent'><integer name='sample_count' value='16'/>"
                          "</sampler>";
    std::string emitter = "<emitter type='constant'/>";
    std::string shape = "sphere", shape_numbers, bsdf = "<bsdf type='diffuse'/>";
    const char* version = "3.0.0";

    std::string text() const {
        return fmt::format(
            "<scene version='{}'>{}<sensor type='{}'>{}<transform name='to_world'>"
            "<lookat origin='0,0,4' target='0,0,0' up='0,1,0'/></transform>"
            "<film type='{}'>{}{}</film>{}</sensor>{}<shape type='{}'>{}{}</shape></scene>",
            version, integrator, camera, camera_numbers, film_plugin, film, filter, sampler,
            emitter, shape, shape_numbers, bsdf);
    }
};

inline std::string domain_scene(const NumberParameter& p, std::string_view plugin,
                                const std::string& value, const std::string& beside = "") {
    DomainScene scene;
    std::string number = number_element(p, value) + companions(plugin, p.name) + beside;
    std::string whole = fmt::format("<{0} type='{1}'>{2}</{0}>", p.tag, plugin, number);
    if (plugin == "sun" || plugin == "sky" || p.also.ends_with("files before 2.0"))
        scene.version = "0.6.0";
    if (p.tag == "bsdf") scene.bsdf = whole;
    if (p.tag == "texture")
        scene.bsdf = fmt::format("<bsdf type='diffuse'><texture name='reflectance' type='{}'>{}"
                                 "</texture></bsdf>",
                                 plugin, number);
    if (p.tag == "integrator") scene.integrator = whole;
    if (p.tag == "sampler") scene.sampler = whole;
    if (p.tag == "rfilter") scene.filter = whole;
    if (p.tag == "film") scene.film_plugin = plugin, scene.film += number;
    if (p.tag == "film" && (p.name == "width" || p.name == "height")) scene.film = number;
    if (p.tag == "emitter" && plugin != "area") scene.emitter = whole;
    if (p.tag == "emitter" && plugin == "area") scene.emitter.clear(), scene.shape_numbers = whole;
    if (p.tag == "sensor") {
        scene.camera = plugin;
        scene.camera_numbers = number;
        if (p.name != "fov" && p.name != "focal_length" && plugin != "orthographic")
            scene.camera_numbers += "<float name='fov' value='10'/>";
    }
    if (p.tag == "shape") scene.shape = plugin, scene.shape_numbers = number;
    if (p.tag == "spectrum" && p.form != NumberForm::step)
        scene.emitter = fmt::format("<emitter type='constant'><spectrum name='radiance' "
                                    "type='{}'>{}</spectrum></emitter>",
                                    plugin, number);
    else if (p.tag == "spectrum")
        scene.emitter = fmt::format("<emitter type='constant'><spectrum name='radiance' "
                                    "value='{}:1, 1e9:1'/></emitter>",
                                    value);
    if (p.tag == "transform")
        scene.shape_numbers =
            "<transform name='to_world'>" + step_element(plugin, p.name, value) + "</transform>";
    return scene.text();
}

} // namespace parhelion::test
