// `parhelion --version`.
#include "host/commands/version.h"

#include "host/cl/opencl.h"
#include "parhelion_version.h"

#include <CLI/Version.hpp>
#include <OpenEXR/OpenEXRConfig.h>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <png.h>
#include <pugixml.hpp>
#include <tbb/version.h>

namespace parhelion {

std::string version_text() {
    std::string text = fmt::format("parhelion {} ({})\n", version_number, version_commit);
    text += fmt::format("OpenCL headers {}, target {}\n", CL_HPP_TARGET_OPENCL_VERSION,
                        CL_TARGET_OPENCL_VERSION);
    text +=
        fmt::format("CLI11 {}, fmt {}.{}.{}, GLM {}.{}.{}.{}, libpng {}, nlohmann-json {}.{}.{}, "
                    "OpenEXR {}, oneTBB {}.{}, "
                    "pugixml {}.{}",
                    CLI11_VERSION, FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100,
                    GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, GLM_VERSION_REVISION,
                    PNG_LIBPNG_VER_STRING, NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                    NLOHMANN_JSON_VERSION_PATCH, OPENEXR_VERSION_STRING, TBB_VERSION_MAJOR,
                    TBB_VERSION_MINOR, PUGIXML_VERSION / 1000, PUGIXML_VERSION % 1000 / 10);
    return text;
}

} // namespace parhelion
