// What the header of an OpenEXR file says.
#include "host/image/exr.h"
#include "host/image/exr_names.h"

#include <ImfChannelList.h>
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

ComponentFormat ExrOptions::component_of(const std::string& channel) const {
    const auto found = layers.find(layer_of(channel));
    return found == layers.end() ? component : found->second;
}

bool is_written_as(const std::string& file, const ExrOptions& options) {
    try {
        const Imf::InputFile input(file.c_str());
        const Imf::Header& header = input.header();
        if (header.compression() != exr_compression(options.compression)) return false;
        const Imf::ChannelList& channels = header.channels();
        for (auto channel = channels.begin(); channel != channels.end(); ++channel)
            if (channel.channel().type != exr_component(options.component_of(channel.name())))
                return false;
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

} // namespace parhelion
