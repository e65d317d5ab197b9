// Tying <ref> elements to the objects they name.
#pragma once

#include "host/scene/mitsuba/document.h"

#include <functional>
#include <map>
#include <string>

namespace parhelion::mitsuba {

using IdTable = std::map<std::string, std::size_t, std::less<>>;

/// Sets Child::object of every reference. One to an id that is not in `ids` is a problem, and taken
/// out. Throws InputError at the <ref> for references by which an object would contain itself.
void resolve_references(Document& document, const IdTable& ids);

} // namespace parhelion::mitsuba
