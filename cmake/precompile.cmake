# Headers that most files include take most of a file's compile time; parhelion_precompile(TARGET MORE...) reads them once.
#
# Every file still includes what it uses: `parhelion lint` checks files without this.
function(parhelion_precompile TARGET)
  if(PARHELION_PRECOMPILE)
    target_precompile_headers(${TARGET} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <string>
      <variant> <vector> <fmt/format.h> <glm/mat4x4.hpp> <glm/vec3.hpp> ${ARGN})
  endif()
endfunction()
