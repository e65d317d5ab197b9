// Typed access to the parameters of one plugin, refusing whatever its reader did not ask for.
#include "host/scene/mitsuba/properties.h"

#include "host/scene/mitsuba/number_parameters.h"
#include "host/scene/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion::mitsuba {

namespace {

bool contains(const std::vector<std::string>& list, std::string_view item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

std::string joined(const std::vector<std::string>& list) {
    std::string result;
    for (const std::string& item : list)
        result += (result.empty() ? "" : ", ") + item;
    return result.empty() ? "none" : result;
}

} // namespace

Properties::Properties(const Document& document, const Object& object,
                       std::vector<std::string>& notes)
    : document_(document), object_(object), notes_(notes) {}

std::string Properties::title() const {
    return object_.tag == "scene" ? std::string("<scene>")
                                  : object_.tag + " plugin " + in_quotes(object_.plugin);
}

const Parameter* Properties::find(std::string_view name) const {
    for (const Parameter& parameter : object_.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

bool Properties::has(std::string_view name) {
    if (!contains(known_, name)) known_.emplace_back(name);
    return find(name) || has_texture(name);
}

void Properties::knows(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        has(name);
}

const SourceLocation& Properties::location_of(std::string_view name) const {
    for (const Child& child : object_.children)
        if (is_texture(child, name)) return child.location;
    const Parameter* const parameter = find(name);
    return parameter ? parameter->location : object_.location;
}

const Parameter* Properties::take(std::string_view name) {
    if (!contains(asked_, name)) asked_.emplace_back(name);
    if (!contains(known_, name)) known_.emplace_back(name);
    for (const Child& child : object_.children) {
        if (child.name != name) continue;
        textures_.emplace_back(name);
        refuse_or_drop(child.location,
                       fmt::format("{}: parameter {} is given as <{} type={}>, which is not "
                                   "supported",
                                   title(), in_quotes(name), target(child).tag,
                                   in_quotes(target(child).plugin)));
        return nullptr;
    }
    const Parameter* const parameter = find(name);
    return parameter && std::holds_alternative<Unread>(parameter->value) ? nullptr : parameter;
}

std::string Properties::spelling(std::string_view name) const {
    const Parameter* const parameter = find(name);
    return in_quotes(parameter ? parameter->spelling : name);
}

std::string Properties::value_message(std::string_view name, const std::string& found,
                                      const std::string& accepted) const {
    return fmt::format("{}: parameter {} is {} (accepted: {})", title(), spelling(name), found,
                       accepted);
}

void Properties::refuse_at(const SourceLocation& place, const std::string& message) const {
    check(); // it may follow from what is wrong already
    refuse(place, message);
}

void Properties::refuse_value(std::string_view name, const std::string& found,
                              const std::string& accepted) const {
    refuse_at(location_of(name), value_message(name, found, accepted));
}

void Properties::refuse_or_drop(const SourceLocation& place, const std::string& what) {
    if (document_.lenient)
        notes_.push_back(place.to_string() + ": " + what + ": left out");
    else
        problems_.attempt([&] { refuse(place, what); });
}

void Properties::keep(std::string_view name, const std::string& found,
                      const std::string& accepted) {
    problems_.attempt([&] { refuse(location_of(name), value_message(name, found, accepted)); });
}

template<typename T>
const T* Properties::take_as(std::string_view name, const char* accepted) {
    const Parameter* const parameter = take(name);
    if (!parameter) return nullptr;
    const T* const value = std::get_if<T>(&parameter->value);
    if (!value) keep(name, "given as <" + parameter->tag + ">", accepted);
    return value;
}

const Domain& Properties::domain(std::string_view name) const {
    return number_parameter(object_.tag, object_.plugin, name).domain;
}

double Properties::checked(std::string_view name, double value) {
    const std::optional<double> taken = placed(domain(name), value);
    if (!taken) keep(name, fmt::format("{}", value), accepted_text(domain(name)));
    if (!taken) return value;
    if (*taken != value)
        note(name, fmt::format("{} is {} and taken as {}", in_quotes(name), value, *taken));
    return *taken;
}

bool Properties::check_each(std::string_view name, std::vector<double>& values) {
    const auto outside = [&](double value) { return !placed(domain(name), value); };
    const auto first = std::find_if(values.begin(), values.end(), outside);
    const auto more = std::count_if(first, values.end(), outside) - 1;
    if (first != values.end()) {
        keep(name,
             more > 0 ? fmt::format("{}, and {} more of its values like it", *first, more)
                      : fmt::format("{}", *first),
             accepted_text(domain(name)));
        return false;
    }
    for (double& value : values)
        value = checked(name, value);
    return true;
}

double Properties::number(std::string_view name, double missing, std::string_view accepted) {
    const Parameter* const parameter = take(name);
    if (!parameter) return missing;
    if (const auto* real = std::get_if<double>(&parameter->value)) return checked(name, *real);
    if (const auto* whole = std::get_if<std::int64_t>(&parameter->value))
        return checked(name, static_cast<double>(*whole));
    keep(name, "given as <" + parameter->tag + ">", std::string(accepted));
    return missing;
}

double Properties::required_number(std::string_view name) {
    if (!has(name))
        refuse_at(location(), fmt::format("{} lacks its parameter {} (accepted: <float>, {})",
                                          title(), in_quotes(name), accepted_text(domain(name))));
    return number(name, 0.0);
}

std::int64_t Properties::integer(std::string_view name, std::int64_t missing) {
    const auto* const value = take_as<std::int64_t>(name, "<integer>");
    if (!value) return missing;
    const auto real = static_cast<double>(*value);
    const double taken = checked(name, real);
    // What is refused, and told of, might not fit where it is used meanwhile.
    return placed(domain(name), real) ? static_cast<std::int64_t>(taken) : missing;
}

bool Properties::boolean(std::string_view name, bool missing) {
    const bool* const value = take_as<bool>(name, "<boolean>");
    return value ? *value : missing;
}

std::string Properties::text(std::string_view name, std::string_view missing) {
    const auto* const value = take_as<std::string>(name, "<string>");
    return value ? *value : std::string(missing);
}

std::string Properties::required_text(std::string_view name) {
    if (!has(name))
        refuse_at(location(),
                  fmt::format("{} lacks its parameter {} (<string>)", title(), in_quotes(name)));
    return text(name, "");
}

std::size_t Properties::choice(std::string_view name, std::string_view missing,
                               std::initializer_list<std::string_view> accepted) {
    const std::string value = text(name, missing);
    const auto found = std::find(accepted.begin(), accepted.end(), lower_case(value));
    if (found == accepted.end()) {
        std::string list;
        for (const std::string_view item : accepted)
            list += (list.empty() ? "" : ", ") + std::string(item);
        if (document_.lenient)
            note(name, value_message(name, in_quotes(value), list) + ": taken as " +
                           in_quotes(*accepted.begin()));
        else
            keep(name, in_quotes(value), list);
        return 0;
    }
    return static_cast<std::size_t>(found - accepted.begin());
}

glm::dvec3 Properties::vector(std::string_view name, const glm::dvec3& missing) {
    const auto* const value = take_as<glm::dvec3>(name, "<point>, <vector>");
    if (!value) return missing;
    return {checked(name, value->x), checked(name, value->y), checked(name, value->z)};
}

glm::dvec3 Properties::required_numbers(std::string_view name) {
    const Parameter* const parameter = find(name);
    if (parameter && std::holds_alternative<glm::dvec3>(parameter->value)) return vector(name, {});
    return glm::dvec3(required_number(name));
}

glm::dmat4 Properties::transform(std::string_view name) {
    const auto* const value = take_as<glm::dmat4>(name, "<transform>");
    return value ? *value : glm::dmat4(1.0);
}

Rgb Properties::color(std::string_view name, const Rgb& missing, SpectrumUse use,
                      std::string_view accepted) {
    const Parameter* const parameter = take(name);
    if (!parameter) return missing;
    if (const auto* rgb = std::get_if<RgbValue>(&parameter->value))
        return {checked(name, rgb->color.r), checked(name, rgb->color.g),
                checked(name, rgb->color.b)};
    if (const auto* spectrum = std::get_if<SpectrumValue>(&parameter->value)) {
        SpectrumValue inside = *spectrum;
        if (!check_each(name, inside.values)) return missing;
        const ConvertedSpectrum converted = to_rgb(inside, use);
        if (converted.clamped)
            note(name, fmt::format("{} lies outside the sRGB gamut and was moved to its border",
                                   in_quotes(name)));
        return {checked(name, converted.color.r), checked(name, converted.color.g),
                checked(name, converted.color.b)};
    }
    if (!std::holds_alternative<double>(parameter->value) &&
        !std::holds_alternative<std::int64_t>(parameter->value)) {
        keep(name, "given as <" + parameter->tag + ">", std::string(accepted));
        return missing;
    }
    return Rgb(number(name, 0.0));
}

std::vector<const Child*> Properties::children(std::string_view tag) {
    asked_tags_.emplace_back(tag);
    std::vector<const Child*> result;
    for (const Child& child : object_.children)
        if (target(child).tag == tag) result.push_back(&child);
    return result;
}

const Object* Properties::only_child(std::string_view tag) {
    const std::vector<const Child*> found = children(tag);
    if (found.size() > 1) {
        const std::string several =
            fmt::format("{} has more than one <{}> (accepted: one)", title(), tag);
        if (!document_.lenient) refuse_at(found[1]->location, several);
        notes_.push_back(found[1]->location.to_string() + ": " + several + "; the first counts");
    }
    return found.empty() ? nullptr : &target(*found[0]);
}

void Properties::note(std::string_view about, const std::string& message) {
    notes_.push_back(location_of(about).to_string() + ": " + message);
}

void Properties::finish() {
    for (const Parameter& parameter : object_.parameters)
        if (!contains(asked_, parameter.name))
            refuse_or_drop(parameter.location,
                           fmt::format("{} has no parameter {} (accepted: {})", title(),
                                       in_quotes(parameter.spelling), joined(known_)));
    for (const Child& child : object_.children)
        if (!contains(asked_tags_, target(child).tag) && !contains(textures_, child.name))
            refuse_or_drop(child.location,
                           fmt::format("{} cannot hold the {} plugin {} (accepted: {})", title(),
                                       target(child).tag, in_quotes(target(child).plugin),
                                       joined(asked_tags_)));
    problems_.throw_if_any();
}

} // namespace parhelion::mitsuba
