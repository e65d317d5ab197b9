// Plugins that stand for a colour or a spectrum, e.g. <spectrum name="radiance" type="d65"/>.
#pragma once

#include "host/scene/mitsuba/document.h"

#include <string>
#include <vector>

namespace parhelion::mitsuba {

/// Whether a spectrum or texture plugin stands for one value wherever it is looked up.
bool is_spectrum_plugin(const Object& object);

/// That value. In Mitsuba's RGB mode `d65` and `uniform` are white; `blackbody`, which it has in
/// its spectral modes only, is Planck's law in W/(m^2 sr nm). Throws InputError.
Value read_spectrum_plugin(const Document& document, const Object& object,
                           std::vector<std::string>& notes);

} // namespace parhelion::mitsuba
