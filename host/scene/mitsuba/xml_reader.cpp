// From XML files to a Document: every kind of element, includes, references and old versions.
#include "host/scene/mitsuba/document.h"
#include "host/scene/mitsuba/references.h"
#include "host/scene/mitsuba/spectrum_plugins.h"
#include "host/scene/mitsuba/substitution.h"
#include "host/scene/mitsuba/versions.h"
#include "host/scene/mitsuba/xml_file.h"
#include "host/scene/mitsuba/xml_values.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace parhelion::mitsuba {

namespace {

constexpr int max_include_depth = 15;
constexpr int max_includes = 1000;
constexpr int max_nesting = 64;
constexpr std::array<std::string_view, 14> object_tags = {
    "scene", "bsdf",    "emitter", "field",  "film",  "integrator", "medium",
    "phase", "rfilter", "sampler", "sensor", "shape", "texture",    "volume"};

/// A <spectrum> can be a plugin too.
bool is_plugin(pugi::xml_node node) {
    return std::string_view(node.name()) == "spectrum" && node.attribute("type");
}

void check_object(const XmlFile& xml, pugi::xml_node node) {
    if (std::string_view(node.name()) == "scene")
        check_attributes(xml, node, {"!version", "type", "id", "name"});
    else if (node == xml.root())
        check_attributes(xml, node, {"!version", "!type", "id", "name"});
    else
        check_attributes(xml, node, {"!type", "id", "name"});
}

class Reader {
public:
    Reader(const std::string& file, const LoadOptions& options)
        : document_{.objects = {},
                    .files = FileFinder(file, options.allow_outside, options.check_file),
                    .notes = {},
                    .own_integrator = options.own_integrator,
                    .lenient = options.lenient,
                    .meshes = options.meshes},
          substitution_(options.parameters) {}

    Document read(const XmlFile& xml, const LoadOptions& options);

private:
    struct Source {
        const XmlFile& xml;
        bool before_2_0;
        int include_depth;
    };

    void read_scene(const XmlFile& xml);
    void read_element(const Source& source, pugi::xml_node node, std::size_t parent, int nesting);
    void read_leaf(const Source& source, pugi::xml_node node, std::size_t parent);
    void read_child(const Source& source, pugi::xml_node node, std::size_t parent, int nesting);
    std::size_t read_object(const Source& source, pugi::xml_node node, int nesting);
    void read_parameter(const Source& source, pugi::xml_node node, std::size_t parent);
    void add_parameter(std::size_t parent, Parameter parameter);
    void read_include(const Source& source, pugi::xml_node node, std::size_t parent, int nesting);
    void read_reference(const Source& source, pugi::xml_node node, std::size_t parent);
    void read_alias(const Source& source, pugi::xml_node node);
    void read_default(const Source& source, pugi::xml_node node);
    void read_path(const Source& source, pugi::xml_node node, std::size_t parent);

    void substitute(const Source& source, pugi::xml_node node);

    Document document_;
    Substitution substitution_;
    IdTable ids_;
    int includes_ = 0;
};

void Reader::substitute(const Source& source, pugi::xml_node node) {
    for (pugi::xml_attribute attribute : node.attributes())
        if (std::string_view(attribute.value()).find('$') != std::string_view::npos)
            attribute.set_value(
                substitution_.apply(attribute.value(), source.xml.location(node)).c_str());
    if (std::string_view(node.name()) == "transform")
        for (const pugi::xml_node step : node.children())
            substitute(source, step);
}

void Reader::read_scene(const XmlFile& xml) {
    const pugi::xml_node root = xml.root();
    const SourceLocation place = xml.location(root);
    if (std::string_view(root.name()) != "scene")
        refuse(place, "the root element is <" + std::string(root.name()) +
                          ">, a scene file starts with <scene version=\"...\">");
    if (!root.attribute("version")) refuse(place, "<scene> lacks the attribute \"version\"");
    const std::array<int, 3> version =
        parse_version(root.attribute("version").value(), place, document_.notes);
    const Source source{xml, version[0] < 2, 0};
    read_object(source, root, 0);
    resolve_references(document_, ids_);
}

Document Reader::read(const XmlFile& xml, const LoadOptions& options) {
    if (!document_.problems.attempt([&] { read_scene(xml); })) document_.problems.throw_if_any();
    for (const auto& [name, value] : options.parameters)
        if (!substitution_.used(name))
            throw InputError("-D " + name + "=" + value + ": " + xml.name() + " uses no $" + name);
    return std::move(document_);
}

/// What is wrong with one element is kept, and the next one read; only a file that is included, or
/// what stands too deep, ends the reading.
void Reader::read_element(const Source& source, pugi::xml_node node, std::size_t parent,
                          int nesting) {
    if (nesting > max_nesting)
        refuse(source.xml.location(node),
               "elements are nested more than " + std::to_string(max_nesting) + " deep");
    const std::string_view tag = node.name();
    const bool object = std::find(object_tags.begin(), object_tags.end(), tag) != object_tags.end();
    if (node.type() != pugi::node_element || (tag != "include" && !object && !is_plugin(node))) {
        document_.problems.attempt([&] { read_leaf(source, node, parent); });
        return;
    }
    if (!document_.problems.attempt([&] { substitute(source, node); })) return;
    if (tag == "include")
        read_include(source, node, parent, nesting);
    else
        read_child(source, node, parent, nesting);
}

void Reader::read_child(const Source& source, pugi::xml_node node, std::size_t parent,
                        int nesting) {
    if (!node.attribute("type") && std::string_view(node.name()) != "scene") {
        document_.problems.attempt([&] { check_object(source.xml, node); });
        return; // nobody knows what it would have been
    }
    Child child{node.attribute("name").value(), source.xml.location(node), {}, 0};
    child.object = read_object(source, node, nesting);
    const Object& object = document_.objects[child.object];
    if (child.name.empty() || !object.id.empty() || !object.children.empty() ||
        !is_spectrum_plugin(object)) {
        document_.objects[parent].children.push_back(std::move(child));
        return;
    }
    document_.problems.attempt([&] {
        Value value = read_spectrum_plugin(document_, object, document_.notes);
        add_parameter(parent,
                      {child.name, child.name, node.name(), child.location, std::move(value)});
    });
    document_.objects.pop_back();
}

/// Everything but plugins and includes.
void Reader::read_leaf(const Source& source, pugi::xml_node node, std::size_t parent) {
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
        refuse(source.xml.location(node), "stray text " + in_quotes(node.value()) + " inside <" +
                                              document_.objects[parent].tag + ">");
    if (node.type() != pugi::node_element) return;
    substitute(source, node);
    const std::string_view tag = node.name();
    if (tag == "ref")
        read_reference(source, node, parent);
    else if (tag == "alias")
        read_alias(source, node);
    else if (tag == "default")
        read_default(source, node);
    else if (tag == "path")
        read_path(source, node, parent);
    else if (document_.lenient && !is_value_tag(tag)) {
        document_.notes.push_back(source.xml.location(node).to_string() + ": unknown element <" +
                                  std::string(tag) + ">: left out");
        return;
    } else
        read_parameter(source, node, parent);
    if (tag != "transform") refuse_content(source.xml, node);
}

std::size_t Reader::read_object(const Source& source, pugi::xml_node node, int nesting) {
    const bool scene = std::string_view(node.name()) == "scene";
    if (scene && !document_.objects.empty())
        refuse(source.xml.location(node), "<scene> cannot stand inside another element");
    document_.problems.attempt([&] { check_object(source.xml, node); });
    const std::size_t index = document_.objects.size();
    Object object{node.name(),
                  scene ? "scene" : node.attribute("type").value(),
                  node.attribute("id").value(),
                  source.xml.location(node),
                  {},
                  {}};
    document_.problems.attempt([&] {
        if (object.id.empty()) return;
        const auto [other, added] = ids_.emplace(object.id, index);
        if (!added)
            refuse(object.location, "id " + in_quotes(object.id) + " is already taken at " +
                                        document_.objects[other->second].location.to_string());
    });
    document_.objects.push_back(std::move(object));
    for (const pugi::xml_node child : node.children())
        read_element(source, child, index, nesting + 1);
    if (source.before_2_0) upgrade_old_object(document_.objects[index]);
    return index;
}

void Reader::read_include(const Source& source, pugi::xml_node node, std::size_t parent,
                          int nesting) {
    check_attributes(source.xml, node, {"!filename", "name"});
    const SourceLocation place = source.xml.location(node);
    if (source.include_depth >= max_include_depth)
        refuse(place,
               "files include each other more than " + std::to_string(max_include_depth) + " deep");
    if (++includes_ > max_includes)
        refuse(place, "more than " + std::to_string(max_includes) + " files are included");
    const XmlFile xml =
        read_xml_file(document_.files.file(node.attribute("filename").value(), place), place);
    pugi::xml_node root = xml.root();
    if (!root.attribute("version"))
        refuse(xml.location(root), "the root element lacks the attribute \"version\"");
    const std::array<int, 3> version =
        parse_version(root.attribute("version").value(), xml.location(root), document_.notes);
    const Source inner{xml, version[0] < 2, source.include_depth + 1};
    if (std::string_view(root.name()) != "scene") {
        read_element(inner, root, parent, nesting);
        return;
    }
    check_attributes(xml, root, {"!version", "type", "id", "name"});
    for (const pugi::xml_node child : root.children())
        read_element(inner, child, parent, nesting + 1);
}

void Reader::read_reference(const Source& source, pugi::xml_node node, std::size_t parent) {
    check_attributes(source.xml, node, {"!id", "name"});
    document_.objects[parent].children.push_back({node.attribute("name").value(),
                                                  source.xml.location(node),
                                                  node.attribute("id").value(), 0});
}

void Reader::read_alias(const Source& source, pugi::xml_node node) {
    check_attributes(source.xml, node, {"!id", "!as"});
    const SourceLocation place = source.xml.location(node);
    const auto known = ids_.find(node.attribute("id").value());
    if (known == ids_.end())
        refuse(place, "<alias>: there is no object with the id " +
                          in_quotes(node.attribute("id").value()) + " above this line");
    if (!ids_.emplace(node.attribute("as").value(), known->second).second)
        refuse(place,
               "<alias>: id " + in_quotes(node.attribute("as").value()) + " is already taken");
}

void Reader::read_default(const Source& source, pugi::xml_node node) {
    check_attributes(source.xml, node, {"!name", "!value"});
    const std::string name = node.attribute("name").value();
    if (name.empty()) refuse(source.xml.location(node), "<default>: the name is empty");
    substitution_.add_default(name, node.attribute("value").value());
}

void Reader::read_path(const Source& source, pugi::xml_node node, std::size_t parent) {
    check_attributes(source.xml, node, {"!value"});
    const SourceLocation place = source.xml.location(node);
    if (parent != 0) refuse(place, "<path> can only stand directly inside <scene>");
    document_.files.add_folder(node.attribute("value").value(), place);
}

void Reader::read_parameter(const Source& source, pugi::xml_node node, std::size_t parent) {
    const SourceLocation place = source.xml.location(node);
    const std::string name = node.attribute("name").value();
    Parameter parameter{source.before_2_0 ? snake_case(name) : name, name, node.name(), place,
                        Unread{}};
    const bool read = document_.problems.attempt([&] {
        parameter.value =
            read_value(source.xml, node, document_.files, document_.notes, source.before_2_0);
    });
    if (!read && (name.empty() || !is_value_tag(node.name()))) return;
    if (name.empty()) refuse(place, std::string("<") + node.name() + ">: the name is empty");
    add_parameter(parent, std::move(parameter));
}

void Reader::add_parameter(std::size_t parent, Parameter parameter) {
    std::vector<Parameter>& all = document_.objects[parent].parameters;
    const auto other = std::find_if(all.begin(), all.end(),
                                    [&](const Parameter& p) { return p.name == parameter.name; });
    if (other == all.end()) {
        all.push_back(std::move(parameter));
        return;
    }
    const std::string twice =
        fmt::format("parameter {} is given twice, first at {}", in_quotes(parameter.spelling),
                    other->location.to_string());
    if (!document_.lenient) refuse(parameter.location, twice);
    document_.notes.push_back(parameter.location.to_string() + ": " + twice +
                              "; the last counts, as in Mitsuba 0.6");
    *other = std::move(parameter);
}

} // namespace

Document read_document(const XmlFile& xml, const LoadOptions& options) {
    return Reader(xml.name(), options).read(xml, options);
}

} // namespace parhelion::mitsuba
