# Headers that most files include take most of a file's compile time; parhelion_precompile(TARGET MORE...) reads them once.
#
# What is in it makes every file read more: nlohmann/json.hpp would cost each of them 0.3 s, and the few that use it 0.8 s.
#
# Every file still includes what it uses: `parhelion lint` checks files of the program without this, each by itself.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(PARHELION_INTRINSICS <immintrin.h>) # of oneTBB and OpenEXR: 43000 lines
endif()
function(parhelion_precompile TARGET)
  if(PARHELION_PRECOMPILE)
    target_precompile_headers(${TARGET} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <string>
      <variant> <vector> <fmt/format.h> <glm/mat4x4.hpp> <glm/vec3.hpp> ${PARHELION_INTRINSICS} ${ARGN})
  endif()
endfunction()

# For a target of parhelion_core's compile options: it reads what that has precompiled.
function(parhelion_precompiled TARGET)
  if(PARHELION_PRECOMPILE)
    target_precompile_headers(${TARGET} REUSE_FROM parhelion_core)
  endif()
endfunction()
