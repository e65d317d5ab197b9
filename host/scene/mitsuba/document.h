// A Mitsuba scene as a tree of plugins with typed parameters: syntax resolved, meaning not yet
// given.
#pragma once

#include "host/problems.h"
#include "host/scene/file_finder.h"
#include "host/scene/load.h"
#include "host/scene/mitsuba/spectrum.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace parhelion::mitsuba {

class XmlFile;

/// A plugin that no table has: what a lenient reader leaves out.
class NotKnown : public InputError {
public:
    using InputError::InputError;
};

/// Of a value that could not be read, which has been said: readers take what a missing one is.
struct Unread {};

using Value = std::variant<bool, std::int64_t, double, std::string, glm::dvec3, RgbValue,
                           SpectrumValue, glm::dmat4, Unread>;

struct Parameter {
    std::string name;     ///< snake_case, whatever the file's version
    std::string spelling; ///< as the file has it
    std::string tag;      ///< the element it was written as: "float", "rgb", ...
    SourceLocation location;
    Value value;
};

/// A plugin inside another, written in place or through a <ref>.
struct Child {
    std::string name; ///< empty when the author gave none
    SourceLocation location;
    std::string reference;  ///< the id asked for; empty when written in place
    std::size_t object = 0; ///< index into Document::objects
};

struct Object {
    std::string tag;    ///< "bsdf", "shape", ...
    std::string plugin; ///< "diffuse", "obj", ...
    std::string id;
    SourceLocation location;
    std::vector<Parameter> parameters;
    std::vector<Child> children;
    bool before_2_0 = false; ///< of a file of such a version
};

struct Document {
    std::vector<Object> objects; ///< the scene itself first
    FileFinder files;
    std::vector<std::string> notes;
    Problems problems{};          ///< of its syntax
    bool own_integrator = false;  ///< LoadOptions::own_integrator
    bool lenient = false;         ///< LoadOptions::lenient
    KeptMeshes* meshes = nullptr; ///< LoadOptions::meshes
};

/// Reads an XML scene with all its includes: parameters substituted, old versions upgraded,
/// references resolved and free of cycles. Its folder is the one in the name of `xml`. What is
/// wrong with one element is in `problems`; throws InputError, with those, where reading cannot go
/// on.
Document read_document(const XmlFile& xml, const LoadOptions& options);

} // namespace parhelion::mitsuba
