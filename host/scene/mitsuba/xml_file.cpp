// One XML file: parsed, with line numbers, and without the dangerous parts of XML.
#include "host/scene/mitsuba/xml_file.h"

#include "host/scene/file_finder.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>

namespace parhelion::mitsuba {

namespace {

constexpr std::size_t max_xml_bytes = std::size_t(1) << 28;

/// The predefined entities and character references; everything else needs a document type.
bool is_plain_reference(std::string_view after_ampersand) {
    constexpr std::array<std::string_view, 6> plain = {"#", "lt;", "gt;", "amp;", "quot;", "apos;"};
    return std::any_of(plain.begin(), plain.end(),
                       [&](std::string_view p) { return after_ampersand.starts_with(p); });
}

} // namespace

XmlFile::XmlFile(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') line_starts_.push_back(i + 1);
    if (const std::size_t zero = text_.find('\0'); zero != std::string::npos)
        refuse(location_of_offset(static_cast<std::ptrdiff_t>(zero)),
               "not an XML text: it holds a zero byte");
    const pugi::xml_parse_result result = document_.load_buffer(
        text_.data(), text_.size(),
        pugi::parse_default | pugi::parse_doctype | pugi::parse_trim_pcdata | pugi::parse_fragment,
        pugi::encoding_utf8);
    if (!result)
        refuse(location_of_offset(result.offset),
               std::string("not well-formed XML: ") + result.description());
    for (const pugi::xml_node node : document_.children())
        if (node.type() == pugi::node_doctype)
            refuse(location_of_offset(static_cast<std::ptrdiff_t>(text_.find("<!DOCTYPE"))),
                   "a document type (<!DOCTYPE ...>) is not accepted");
    refuse_entities();
    if (!root()) refuse({name_, 0}, "the file holds no XML element");
    refuse_beside_root();
}

/// The parser takes fragments, to see what stands before and after the root, and nothing may.
void XmlFile::refuse_beside_root() const {
    for (const pugi::xml_node node : document_.children()) {
        if (node.type() == pugi::node_element && node != root())
            refuse(location(node), std::string("a second root element <") + node.name() +
                                       "> (the first: " + location(root()).to_string() +
                                       "; accepted: one)");
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
            refuse(location(node), "stray text " + in_quotes(node.value()) + " beside the root <" +
                                       root().name() + ">");
    }
}

void XmlFile::refuse_entities() const {
    for (std::size_t i = 0; (i = text_.find_first_of("&<", i)) != std::string::npos; ++i) {
        const std::string_view rest = std::string_view(text_).substr(i);
        if (rest.starts_with("<!--"))
            i = std::min(text_.find("-->", i), text_.size() - 1);
        else if (rest.starts_with("<![CDATA["))
            i = std::min(text_.find("]]>", i), text_.size() - 1);
        else if (rest[0] == '&' && !is_plain_reference(rest.substr(1)))
            refuse(location_of_offset(static_cast<std::ptrdiff_t>(i)),
                   "entity " +
                       in_quotes(rest.substr(0, std::min<std::size_t>(rest.find(';'), 20))) +
                       " is not accepted (only &lt; &gt; &amp; &quot; &apos; and &#...;)");
    }
}

SourceLocation XmlFile::location(pugi::xml_node node) const {
    return location_of_offset(node.offset_debug());
}

SourceLocation XmlFile::location_of_offset(std::ptrdiff_t offset) const {
    if (offset < 0) return {name_, 0};
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(),
                                       static_cast<std::size_t>(offset));
    return {name_, static_cast<int>(next - line_starts_.begin())};
}

XmlFile read_xml_file(const std::filesystem::path& path, const SourceLocation& asked_from) {
    return {path.string(), read_whole_file(path, asked_from, max_xml_bytes)};
}

void check_attributes(const XmlFile& xml, pugi::xml_node node,
                      std::initializer_list<std::string_view> allowed) {
    const auto bare = [](std::string_view a) { return a[0] == '!' ? a.substr(1) : a; };
    const std::string element = std::string("<") + node.name() + ">";
    for (const pugi::xml_attribute attribute : node.attributes()) {
        const auto same = [&](std::string_view a) { return bare(a) == attribute.name(); };
        if (std::any_of(allowed.begin(), allowed.end(), same)) continue;
        std::string list;
        for (const std::string_view a : allowed)
            list += (list.empty() ? "" : ", ") + std::string(bare(a));
        refuse(xml.location(node), element + " has an unexpected attribute " +
                                       in_quotes(attribute.name()) + " (accepted: " + list + ")");
    }
    for (const std::string_view a : allowed)
        if (a[0] == '!' && !node.attribute(std::string(bare(a)).c_str()))
            refuse(xml.location(node), element + " lacks the attribute " + in_quotes(bare(a)));
}

void refuse_content(const XmlFile& xml, pugi::xml_node node) {
    for (const pugi::xml_node child : node.children())
        if (child.type() == pugi::node_element)
            refuse(xml.location(child),
                   std::string("<") + child.name() + "> cannot stand inside <" + node.name() + ">");
}

} // namespace parhelion::mitsuba
