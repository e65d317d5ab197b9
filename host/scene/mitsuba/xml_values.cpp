// The elements that hold a value: <float>, <rgb>, <transform> and their kin.
#include "host/scene/mitsuba/xml_values.h"

#include "host/scene/mitsuba/number_parameters.h"
#include "host/scene/mitsuba/transforms.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace parhelion::mitsuba {

namespace {

constexpr std::size_t max_spectrum_bytes = std::size_t(1) << 24;

struct Element {
    const XmlFile& xml;
    pugi::xml_node node;
    const FileFinder& files;
    std::vector<std::string>& notes;
    bool before_2_0;

    SourceLocation place() const { return xml.location(node); }
    std::string_view attribute(const char* name) const { return node.attribute(name).value(); }
    std::string title() const { return std::string("<") + node.name() + ">"; }
};

double number_attribute(const Element& e, const char* name) {
    const std::optional<double> value = parse_number(e.attribute(name));
    if (!value)
        refuse(e.place(),
               e.title() + ": " + in_quotes(e.attribute(name)) + " is not a finite number");
    return *value;
}

void check_step(const Element& e, const char* name, double value) {
    const Domain& domain = step_domain(lower_case(e.node.name()), name);
    if (placed(domain, value) != value)
        refuse(e.place(), fmt::format("{}: {} is {} (accepted: {})", e.title(), in_quotes(name),
                                      value, accepted_text(domain)));
}

double step_number(const Element& e, const char* name) {
    const double value = number_attribute(e, name);
    check_step(e, name, value);
    return value;
}

/// `value="a"`, `value="a b c"`, or x, y and z, of which some may be `missing`.
glm::dvec3 vector_attributes(const Element& e, double missing) {
    const std::array<const char*, 3> axes = {"x", "y", "z"};
    if (!e.node.attribute("value")) {
        glm::dvec3 result(missing);
        for (int i = 0; i < 3; ++i)
            if (e.node.attribute(axes[i])) result[i] = number_attribute(e, axes[i]);
        return result;
    }
    for (const char* const axis : axes)
        if (e.node.attribute(axis))
            refuse(e.place(), e.title() + " takes either value or x, y and z, not both");
    const std::string_view text = e.attribute("value");
    if (split(text, ", \t\r\n").size() == 1) return glm::dvec3(number_attribute(e, "value"));
    return parse_vector(text, e.title().c_str(), e.place());
}

glm::dvec3 step_vector(const Element& e, double missing) {
    const glm::dvec3 v = vector_attributes(e, missing);
    for (int i = 0; i < 3; ++i)
        check_step(e, "x, y, z", v[i]);
    return v;
}

Value read_float(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!value"});
    return number_attribute(e, "value");
}

Value read_integer(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!value"});
    const std::optional<std::int64_t> value = parse_integer(e.attribute("value"));
    if (!value)
        refuse(e.place(), "<integer>: " + in_quotes(e.attribute("value")) + " is not an integer");
    return *value;
}

Value read_boolean(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!value"});
    const std::string text = lower_case(e.attribute("value"));
    if (text != "true" && text != "false")
        refuse(e.place(), "<boolean>: " + in_quotes(e.attribute("value")) +
                              " is not a boolean (accepted: true, false)");
    return text == "true";
}

Value read_string(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!value"});
    return std::string(e.attribute("value"));
}

Value read_vector(const Element& e) {
    if (e.node.attribute("value"))
        check_attributes(e.xml, e.node, {"!name", "!value", "x", "y", "z"});
    else
        check_attributes(e.xml, e.node, {"!name", "!x", "!y", "!z"});
    return vector_attributes(e, 0.0);
}

Value read_rgb(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!value"});
    return parse_rgb(e.attribute("value"), e.place());
}

Value read_srgb(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!value"});
    return parse_srgb(e.attribute("value"), e.place());
}

/// temperature="5000" or "5000K", and a factor.
Value read_blackbody(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "!temperature", "scale"});
    std::string_view text = e.attribute("temperature");
    if (text.ends_with('K') || text.ends_with('k')) text.remove_suffix(1);
    const Domain& domain = number_parameter("spectrum", "blackbody", "temperature").domain;
    const std::optional<double> kelvins = parse_number(text);
    if (!kelvins || placed(domain, *kelvins) != kelvins)
        refuse(e.place(), "<blackbody>: the temperature is " +
                              in_quotes(e.attribute("temperature")) +
                              " (accepted: " + accepted_text(domain) + ")");
    SpectrumValue spectrum = blackbody(*kelvins);
    const double scale = e.node.attribute("scale") ? number_attribute(e, "scale") : 1.0;
    for (double& value : spectrum.values)
        value *= scale;
    return spectrum;
}

/// Without wavelengths, of a file older than 2.0: linear RGB, as Mitsuba 0.x has it unless it is
/// built for spectra. White, where Mitsuba 3 lets a light of one value be constant over
/// wavelengths.
Value read_old_spectrum(const Element& e) {
    const std::string_view parent = e.node.parent().name();
    if (parent == "emitter")
        e.notes.push_back(e.place().to_string() +
                          ": <spectrum>: a light without wavelengths in a file older than 2.0 is "
                          "linear RGB, as in Mitsuba 0.x (one value in Mitsuba 3: reddish)");
    return parse_rgb(e.attribute("value"), e.place());
}

Value read_spectrum(const Element& e) {
    check_attributes(e.xml, e.node, {"!name", "value", "filename"});
    const bool has_file = !e.attribute("filename").empty();
    if (has_file == !e.attribute("value").empty())
        refuse(e.place(), "<spectrum> takes either value or filename");
    const bool without_wavelengths = e.attribute("value").find(':') == std::string_view::npos;
    if (!has_file && e.before_2_0 && without_wavelengths) return read_old_spectrum(e);
    if (!has_file) return parse_spectrum(e.attribute("value"), e.place());
    const std::filesystem::path path =
        e.files.file(std::string(e.attribute("filename")), e.place());
    if (lower_case(path.extension().string()) != ".spd")
        refuse(e.place(), "<spectrum>: " + in_quotes(path.string()) + " is not an .spd file");
    return parse_spectrum_file(read_whole_file(path, e.place(), max_spectrum_bytes),
                               {path.string(), 0});
}

glm::dmat4 read_rotate(const Element& e) {
    check_attributes(e.xml, e.node, {"!angle", "value", "x", "y", "z"});
    const glm::dvec3 axis = step_vector(e, 0.0);
    const double angle = step_number(e, "angle");
    if (axis == glm::dvec3(0.0)) {
        if (std::remainder(angle, 360.0) == 0.0) return glm::dmat4(1.0); // as in Mitsuba 3
        refuse(e.place(), fmt::format("<rotate>: the axis (x, y, z) cannot be zero for an angle of "
                                      "{} (accepted: another axis, or angle 0)",
                                      angle));
    }
    if (std::abs(glm::length(axis) - 1.0) > 1e-5)
        e.notes.push_back(e.place().to_string() +
                          ": <rotate>: the axis is not a unit vector; it is used as a direction "
                          "(Mitsuba 3 gives a matrix that is no rotation)");
    return rotation(axis, angle);
}

glm::dmat4 read_look_at(const Element& e) {
    check_attributes(e.xml, e.node, {"!origin", "!target", "up"});
    const auto read = [&](const char* name) {
        const std::string what = e.title() + " " + name;
        const glm::dvec3 v = parse_vector(e.attribute(name), what.c_str(), e.place());
        for (int i = 0; i < 3; ++i)
            check_step(e, "origin, target, up", v[i]);
        return v;
    };
    const glm::dvec3 up = e.attribute("up").empty() ? glm::dvec3(0.0) : read("up");
    return look_at(read("origin"), read("target"), up, e.place());
}

glm::dmat4 read_step(const Element& e) {
    const std::string_view tag = e.node.name();
    refuse_content(e.xml, e.node);
    if (tag == "rotate") return read_rotate(e);
    if (tag == "lookat" || tag == "lookAt") return read_look_at(e);
    if (tag == "matrix") {
        check_attributes(e.xml, e.node, {"!value"});
        return parse_matrix(e.attribute("value"), e.place());
    }
    if (tag != "translate" && tag != "scale")
        refuse(e.place(), "<" + std::string(tag) +
                              "> cannot stand inside <transform> (accepted: translate, rotate, "
                              "scale, matrix, lookat)");
    check_attributes(e.xml, e.node, {"value", "x", "y", "z"});
    if (tag == "translate") return glm::translate(glm::dmat4(1.0), step_vector(e, 0.0));
    return glm::scale(glm::dmat4(1.0), step_vector(e, 1.0));
}

/// The steps act in the order they are written.
Value read_transform(const Element& e) {
    check_attributes(e.xml, e.node, {"!name"});
    glm::dmat4 result(1.0);
    for (const pugi::xml_node child : e.node.children())
        if (child.type() == pugi::node_element)
            result = read_step({e.xml, child, e.files, e.notes, e.before_2_0}) * result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (const Domain& domain = step_domain("matrix", "value");
                !placed(domain, result[column][row]))
                refuse(e.place(),
                       fmt::format("<transform>: the product of its steps has the value {} "
                                   "(accepted: {})",
                                   result[column][row], accepted_text(domain)));
    return result;
}

struct ValueReader {
    std::string_view tag;
    Value (*read)(const Element&);
};

constexpr std::array<ValueReader, 11> value_readers = {{{"float", read_float},
                                                        {"integer", read_integer},
                                                        {"boolean", read_boolean},
                                                        {"string", read_string},
                                                        {"vector", read_vector},
                                                        {"point", read_vector},
                                                        {"rgb", read_rgb},
                                                        {"srgb", read_srgb},
                                                        {"blackbody", read_blackbody},
                                                        {"spectrum", read_spectrum},
                                                        {"transform", read_transform}}};

} // namespace

bool is_value_tag(std::string_view tag) {
    return std::any_of(value_readers.begin(), value_readers.end(),
                       [&](const ValueReader& reader) { return reader.tag == tag; });
}

Value read_value(const XmlFile& xml, pugi::xml_node node, const FileFinder& files,
                 std::vector<std::string>& notes, bool before_2_0) {
    const std::string_view tag = node.name();
    for (const ValueReader& reader : value_readers)
        if (reader.tag == tag) return reader.read({xml, node, files, notes, before_2_0});
    std::string accepted;
    for (const ValueReader& reader : value_readers)
        accepted += std::string(reader.tag) + ", ";
    refuse(xml.location(node), "unknown element <" + std::string(tag) + "> (accepted: " + accepted +
                                   "ref, include, alias, default, path, or the kind of a plugin)");
}

} // namespace parhelion::mitsuba
