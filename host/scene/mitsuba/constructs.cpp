// The plugins of a Mitsuba document.
#include "host/scene/mitsuba/document.h"
#include "host/scene/mitsuba/scene_builder.h"
#include "host/scene/mitsuba/xml_file.h"

namespace parhelion::mitsuba {

std::vector<Construct> xml_constructs(const std::string& file, const LoadOptions& options) {
    const Document document = read_document(read_xml_file(file, {file, 0}), options);
    std::vector<Construct> constructs;
    for (std::size_t i = 1; i < document.objects.size(); i++) { // behind the scene itself
        const Object& object = document.objects[i];
        Construct construct{object.tag, object.plugin, {object.location}};
        for (const Parameter& parameter : object.parameters)
            construct.places.push_back(parameter.location);
        constructs.push_back(std::move(construct));
    }
    return constructs;
}

} // namespace parhelion::mitsuba
