// Typed access to the parameters of one plugin, refusing whatever its reader did not ask for.
#pragma once

#include "host/domain.h"
#include "host/scene/mitsuba/document.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion::mitsuba {

/// What a colour that may be a texture can be given as, for messages.
inline constexpr std::string_view color_or_texture = "<rgb>, <spectrum>, <float>, <texture>";

/// Every query takes its parameter; `finish` refuses those that are left. What is wrong with a
/// value is kept, so that the others are looked at too, and thrown by `finish` or what throws
/// before: an InputError, a line for each, with the parameter's own line and spelling. Numbers lie
/// in the domain that number_parameters.h has for them, or are refused, or mapped with a note.
class Properties {
public:
    Properties(const Document& document, const Object& object, std::vector<std::string>& notes);

    const Object& object() const { return object_; }
    const SourceLocation& location() const { return object_.location; }

    /// As a value or as a texture.
    bool has(std::string_view name);
    bool has_texture(std::string_view name) const;
    /// Names that the plugin has and the reader may not come to.
    void knows(std::initializer_list<std::string_view> names);
    /// The line of a parameter that is there, else of the plugin.
    const SourceLocation& location_of(std::string_view name) const;

    double number(std::string_view name, double missing, std::string_view accepted = "<float>");
    double required_number(std::string_view name);
    std::int64_t integer(std::string_view name, std::int64_t missing);
    /// A number found in a text.
    double checked(std::string_view name, double value);
    bool boolean(std::string_view name, bool missing);
    std::string text(std::string_view name, std::string_view missing);
    std::string required_text(std::string_view name);
    /// The position of the (case-insensitive) value in `accepted`.
    std::size_t choice(std::string_view name, std::string_view missing,
                       std::initializer_list<std::string_view> accepted);
    glm::dvec3 vector(std::string_view name, const glm::dvec3& missing);
    /// A vector, or a number three times; refuses to be without.
    glm::dvec3 required_numbers(std::string_view name);
    glm::dmat4 transform(std::string_view name);
    Rgb color(std::string_view name, const Rgb& missing, SpectrumUse use,
              std::string_view accepted = "<rgb>, <spectrum>, <float>");
    /// A colour, or the texture of that name.
    Textured<Rgb> textured_color(std::string_view name, const Textured<Rgb>& missing,
                                 SpectrumUse use);
    Textured<double> textured_number(std::string_view name, const Textured<double>& missing);

    /// Takes the plugins of kind `tag` inside this one, in their order.
    std::vector<const Child*> children(std::string_view tag);
    /// The one image that it holds, whatever its name, of values in any unit; refuses to be
    /// without.
    TextureUse only_bitmap();
    /// The one plugin of kind `tag`, or null; refuses a second one.
    const Object* only_child(std::string_view tag);
    const Object& target(const Child& child) const { return document_.objects[child.object]; }
    const FileFinder& files() const { return document_.files; }

    /// One line for the user, with this plugin's (or the parameter's) place.
    void note(std::string_view about, const std::string& message);

    [[noreturn]] void refuse_value(std::string_view name, const std::string& found,
                                   const std::string& accepted) const;
    /// "bsdf plugin "diffuse""
    std::string title() const;

    /// Throws what has been kept, before something is made of values that are wrong.
    void check() const { problems_.throw_if_any(); }
    void finish();

private:
    std::string value_message(std::string_view name, const std::string& found,
                              const std::string& accepted) const;
    /// Keeps what `refuse_value` would throw.
    void keep(std::string_view name, const std::string& found, const std::string& accepted);
    [[noreturn]] void refuse_at(const SourceLocation& place, const std::string& message) const;
    std::string spelling(std::string_view name) const;
    const Parameter* take(std::string_view name);
    /// Keeps what is refused, or where the document is read leniently notes that it is left out.
    void refuse_or_drop(const SourceLocation& place, const std::string& what);
    bool is_texture(const Child& child, std::string_view name) const;
    const Object* take_texture(std::string_view name);
    TextureUse texture_use(std::string_view name, const Object& texture);
    const Parameter* find(std::string_view name) const;
    const Domain& domain(std::string_view name) const;
    /// As `checked`; of several that are refused one line tells. Whether none is.
    bool check_each(std::string_view name, std::vector<double>& values);
    template<typename T>
    const T* take_as(std::string_view name, const char* accepted);

    const Document& document_;
    const Object& object_;
    std::vector<std::string>& notes_;
    Problems problems_;
    std::vector<std::string> asked_;      ///< names of parameters that were read
    std::vector<std::string> known_;      ///< and of those that could have been
    std::vector<std::string> asked_tags_; ///< kinds of children
    std::vector<std::string> textures_;   ///< names of children that were read
};

} // namespace parhelion::mitsuba
