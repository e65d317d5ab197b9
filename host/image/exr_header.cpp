// What the header of an OpenEXR file says.
#include "host/image/exr.h"

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <exception>

namespace parhelion {

std::string exr_attribute(const std::string& file, const std::string& name) {
    try {
        const Imf::InputFile input(file.c_str());
        const auto* text = input.header().findTypedAttribute<Imf::StringAttribute>(name);
        return text ? text->value() : "";
    } catch (const std::exception&) {
        return "";
    }
}

} // namespace parhelion
