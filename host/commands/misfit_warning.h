// What the user is told of values that the written file does not hold as they are.
#pragma once

#include "host/image/exr.h"
#include "host/render/report.h"

#include <string>

namespace parhelion {

/// One warning about all of `report.misfits`: how many, in which channels, where the first is of
/// each, and what the file holds in their place; "" where there are none. `written`: what an .exr
/// was written as.
std::string misfit_warning(const std::string& file, const ExrOptions& written,
                           const RenderReport& report);

} // namespace parhelion
