# What is installed, and the Debian package: `cmake --install build/release --prefix P`, `cpack -G DEB` in build/release.
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

install(TARGETS parhelion parhelion-stress RUNTIME)
install(DIRECTORY scenes/ DESTINATION share/parhelion/scenes OPTIONAL)
# With all that they link to; tests/house/installed_links.sh follows the links.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md DESTINATION share/doc/parhelion)
install(FILES LICENSE DESTINATION share/doc/parhelion RENAME copyright) # where Debian looks
install(FILES benchmarks/README.md DESTINATION share/doc/parhelion/benchmarks)
install(FILES docs/accuracy.md docs/farm.md docs/frames.md docs/parameters.md DESTINATION share/doc/parhelion/docs)
install(DIRECTORY docs/farm DESTINATION share/doc/parhelion/docs USE_SOURCE_PERMISSIONS) # scripts, to be run
install(DIRECTORY docs/gallery docs/licences DESTINATION share/doc/parhelion/docs)

# The manuals and what shells complete is what the programs say, asked when they are installed.
install(CODE "set(PROGRAM \"$<TARGET_FILE:parhelion>\")\nset(STRESS_PROGRAM \"$<TARGET_FILE:parhelion-stress>\")\nset(MADE_FOLDER \"${PROJECT_BINARY_DIR}/generated/made\")")
install(SCRIPT cmake/install_made.cmake)

set(CPACK_PACKAGE_NAME parhelion)
set(CPACK_PACKAGE_VENDOR Parhelion)
set(CPACK_PACKAGE_CONTACT "The authors of Parhelion <parhelion@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "physically based renderer for the command line, on OpenCL")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "Parhelion renders Mitsuba 3 scenes to linear EXR files, on processors and\n\
 graphics cards alike, through OpenCL. Its images are the same to the bit\n\
 however the work is split, and it tests its own numerics.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Beside the libraries that dpkg-shlibdeps finds: the loader, and a driver, which no program links.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "ocl-icd-libopencl1, pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "glmark2-data") # the mesh of scenes/bunny
set(CPACK_GENERATOR DEB)
include(CPack)
