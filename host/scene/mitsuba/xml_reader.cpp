// From XML files to a Document: every kind of element, includes, references and old versions.
#include "host/scene/mitsuba/document.h"
#include "host/scene/mitsuba/references.h"
#include "host/scene/mitsuba/substitution.h"
#include "host/scene/mitsuba/xml_file.h"
#include "host/scene/mitsuba/xml_values.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>
#include <map>

namespace parhelion::mitsuba {

namespace {

constexpr int max_include_depth = 15;
constexpr int max_includes = 1000;
constexpr int max_nesting = 64;
constexpr int newest_version = 3; ///< of the format that this reader follows
constexpr std::array<std::string_view, 14> object_tags = {
    "scene", "bsdf",    "emitter", "field",  "film",  "integrator", "medium",
    "phase", "rfilter", "sampler", "sensor", "shape", "texture",    "volume"};

/// Numbers "1.2" or "1.2.3", as in the version attribute; a newer one than this reader's is noted.
std::array<int, 3> parse_version(std::string_view text, const SourceLocation& place,
                                 std::vector<std::string>& notes) {
    const std::vector<std::string_view> parts = split(text, ".");
    const auto dots = std::count(text.begin(), text.end(), '.');
    std::array<int, 3> version{};
    bool good = !parts.empty() && parts.size() <= 3 && dots == std::ssize(parts) - 1;
    for (std::size_t i = 0; good && i < parts.size(); ++i) {
        const std::optional<std::int64_t> number = parse_integer(parts[i]);
        good = number && *number >= 0 && *number <= 9999;
        if (good) version[i] = static_cast<int>(*number);
    }
    if (!good)
        refuse(place, "version " + in_quotes(text) + " is not a version number such as \"3.0.0\"");
    if (version[0] > newest_version)
        notes.push_back(place.to_string() + ": version " + in_quotes(text) +
                        " of the format is newer than " + std::to_string(newest_version) +
                        ", as which the file is read");
    return version;
}

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// fovAxis -> fov_axis: files older than version 2.0 name their parameters so.
std::string snake_case(std::string_view name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (i > 0 && is_lower(name[i - 1]) && is_upper(name[i])) {
            result += '_';
            for (; i < name.size() && is_upper(name[i]); ++i)
                result += static_cast<char>(name[i] - 'A' + 'a');
            --i;
        } else {
            result += name[i];
        }
    }
    return result;
}

class Reader {
public:
    Reader(const std::string& file, const LoadOptions& options)
        : document_{{}, FileFinder(file, options.allow_outside), {}},
          substitution_(options.parameters) {}

    Document read(const XmlFile& xml, const LoadOptions& options);

private:
    struct Source {
        const XmlFile& xml;
        bool before_2_0;
        int include_depth;
    };

    void read_element(const Source& source, pugi::xml_node node, std::size_t parent, int nesting);
    std::size_t read_object(const Source& source, pugi::xml_node node, int nesting);
    void read_parameter(const Source& source, pugi::xml_node node, std::size_t parent);
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

Document Reader::read(const XmlFile& xml, const LoadOptions& options) {
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
    for (const auto& [name, value] : options.parameters)
        if (!substitution_.used(name))
            throw InputError("-D " + name + "=" + value + ": " + xml.name() + " uses no $" + name);
    return std::move(document_);
}

void Reader::read_element(const Source& source, pugi::xml_node node, std::size_t parent,
                          int nesting) {
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
        refuse(source.xml.location(node), "stray text " + in_quotes(node.value()) + " inside <" +
                                              document_.objects[parent].tag + ">");
    if (node.type() != pugi::node_element) return;
    if (nesting > max_nesting)
        refuse(source.xml.location(node),
               "elements are nested more than " + std::to_string(max_nesting) + " deep");
    substitute(source, node);
    const std::string_view tag = node.name();
    const bool object = std::find(object_tags.begin(), object_tags.end(), tag) != object_tags.end();
    if (object || (tag == "spectrum" && node.attribute("type"))) {
        Child child{node.attribute("name").value(), source.xml.location(node), {}, 0};
        child.object = read_object(source, node, nesting);
        document_.objects[parent].children.push_back(std::move(child));
        return;
    }
    if (tag == "include")
        read_include(source, node, parent, nesting);
    else if (tag == "ref")
        read_reference(source, node, parent);
    else if (tag == "alias")
        read_alias(source, node);
    else if (tag == "default")
        read_default(source, node);
    else if (tag == "path")
        read_path(source, node, parent);
    else
        read_parameter(source, node, parent);
    if (tag != "transform") refuse_content(source.xml, node);
}

/// The number of that name, which is taken away; `missing` where there is none.
double take_number(Object& object, std::string_view name, double missing, SourceLocation& place) {
    const auto found = std::find_if(object.parameters.begin(), object.parameters.end(),
                                    [&](const Parameter& p) { return p.name == name; });
    if (found == object.parameters.end()) return missing;
    const auto* const real = std::get_if<double>(&found->value);
    const auto* const whole = std::get_if<std::int64_t>(&found->value);
    if (!real && !whole) return missing; // refused as a parameter that there is not
    const double number = real ? *real : static_cast<double>(*whole);
    place = found->location;
    object.parameters.erase(found);
    return number;
}

/// What textures of older versions have in place of to_uv: moved first, then scaled.
void upgrade_texture(Object& object) {
    SourceLocation place;
    const double u = take_number(object, "uoffset", 0.0, place);
    const double v = take_number(object, "voffset", 0.0, place);
    const double scale_u = take_number(object, "uscale", 1.0, place);
    const double scale_v = take_number(object, "vscale", 1.0, place);
    if (place.file.empty()) return;
    glm::dmat4 to_uv(1.0);
    to_uv[0][0] = scale_u, to_uv[1][1] = scale_v;
    to_uv[3][0] = scale_u * u, to_uv[3][1] = scale_v * v;
    object.parameters.push_back({"to_uv", "transform", place, to_uv});
}

std::size_t Reader::read_object(const Source& source, pugi::xml_node node, int nesting) {
    const bool scene = std::string_view(node.name()) == "scene";
    if (scene && !document_.objects.empty())
        refuse(source.xml.location(node), "<scene> cannot stand inside another element");
    const bool file_root = node == source.xml.root();
    if (scene)
        check_attributes(source.xml, node, {"!version", "type", "id", "name"});
    else if (file_root)
        check_attributes(source.xml, node, {"!version", "!type", "id", "name"});
    else
        check_attributes(source.xml, node, {"!type", "id", "name"});
    const std::size_t index = document_.objects.size();
    Object object{node.name(),
                  scene ? "scene" : node.attribute("type").value(),
                  node.attribute("id").value(),
                  source.xml.location(node),
                  {},
                  {}};
    if (!object.id.empty()) {
        const auto [other, added] = ids_.emplace(object.id, index);
        if (!added)
            refuse(object.location, "id " + in_quotes(object.id) + " is already taken at " +
                                        document_.objects[other->second].location.to_string());
    }
    document_.objects.push_back(std::move(object));
    for (const pugi::xml_node child : node.children())
        read_element(source, child, index, nesting + 1);
    if (Object& read = document_.objects[index]; source.before_2_0 && read.tag == "texture")
        upgrade_texture(read);
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
    Value value = read_value(source.xml, node, document_.files, document_.notes);
    std::string name = node.attribute("name").value();
    if (name.empty()) refuse(place, std::string("<") + node.name() + ">: the name is empty");
    if (source.before_2_0) name = snake_case(name);
    Object& object = document_.objects[parent];
    if (source.before_2_0 && object.plugin == "diffuse" && name == "diffuse_reflectance")
        name = "reflectance";
    for (const Parameter& other : object.parameters)
        if (other.name == name)
            refuse(place, "parameter " + in_quotes(name) + " is given twice, first at " +
                              other.location.to_string());
    object.parameters.push_back({std::move(name), node.name(), place, std::move(value)});
}

} // namespace

Document read_document(const XmlFile& xml, const LoadOptions& options) {
    return Reader(xml.name(), options).read(xml, options);
}

} // namespace parhelion::mitsuba
