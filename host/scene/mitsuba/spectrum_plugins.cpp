// Plugins that stand for a colour or a spectrum, e.g. <spectrum name="radiance" type="d65"/>.
#include "host/scene/mitsuba/spectrum_plugins.h"

#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/properties.h"

#include <algorithm>

namespace parhelion::mitsuba {

namespace {

Value read_d65(Properties& p) {
    return RgbValue{p.color("color", Rgb(1.0), SpectrumUse::unbounded) * p.number("scale", 1.0)};
}

Value read_uniform(Properties& p) { return RgbValue{Rgb(p.required_number("value"))}; }

Value read_srgb(Properties& p) {
    if (!p.has("color")) p.refuse_value("color", "missing", "<rgb>");
    return RgbValue{p.color("color", Rgb(0.0), SpectrumUse::reflectance)};
}

Value read_blackbody(Properties& p) { return blackbody(p.required_number("temperature")); }

using SpectrumReader = Value (*)(Properties&);

constexpr PluginTable<SpectrumReader, 4> spectrum_plugins = {{{"d65", read_d65},
                                                              {"uniform", read_uniform},
                                                              {"srgb", read_srgb},
                                                              {"blackbody", read_blackbody}}};

} // namespace

bool is_spectrum_plugin(const Object& object) {
    return (object.tag == "spectrum" || object.tag == "texture") &&
           std::any_of(spectrum_plugins.begin(), spectrum_plugins.end(),
                       [&](const auto& entry) { return entry.name == object.plugin; });
}

Value read_spectrum_plugin(const Document& document, const Object& object,
                           std::vector<std::string>& notes) {
    Object spectrum = object;
    spectrum.tag = "spectrum"; // the same plugin, whatever the element
    Properties p(document, spectrum, notes);
    const Value value = find_plugin(spectrum_plugins, spectrum)(p);
    p.finish();
    return value;
}

} // namespace parhelion::mitsuba
