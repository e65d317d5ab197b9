# Sources made at build time: the version header, and the kernels as text inside the program.
set(PARHELION_GENERATED_DIR ${CMAKE_CURRENT_BINARY_DIR}/generated)

# The commit is asked for at every build, but the header changes (and rebuilds its users) only when the answer does.
add_custom_target(parhelion_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_CURRENT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
    -DOUTPUT=${PARHELION_GENERATED_DIR}/parhelion_version.h -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/version.cmake
  BYPRODUCTS ${PARHELION_GENERATED_DIR}/parhelion_version.h
  COMMENT "Asking git for the commit" VERBATIM)

file(GLOB_RECURSE KERNEL_FILES CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/kernels
  kernels/*.cl kernels/*.h)
list(SORT KERNEL_FILES)
# The list is itself a dependency: a kernel file that goes away must also rebuild the text.
set(KERNEL_LIST ${PARHELION_GENERATED_DIR}/kernel_files.txt)
list(JOIN KERNEL_FILES "\n" KERNEL_LINES)
file(CONFIGURE OUTPUT ${KERNEL_LIST} CONTENT "${KERNEL_LINES}" @ONLY)
set(KERNEL_PATHS ${KERNEL_FILES})
list(TRANSFORM KERNEL_PATHS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/kernels/)

set(EMBEDDED_KERNELS_CPP ${PARHELION_GENERATED_DIR}/embedded_kernels.cpp)
add_custom_command(OUTPUT ${EMBEDDED_KERNELS_CPP}
  COMMAND ${CMAKE_COMMAND} -DKERNEL_DIR=${CMAKE_CURRENT_SOURCE_DIR}/kernels -DKERNEL_LIST=${KERNEL_LIST}
    -DOUTPUT=${EMBEDDED_KERNELS_CPP} -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_kernels.cmake
  DEPENDS ${KERNEL_PATHS} ${KERNEL_LIST} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_kernels.cmake
  COMMENT "Embedding the kernels" VERBATIM)
