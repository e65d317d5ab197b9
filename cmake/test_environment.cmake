# Read by ctest before it runs: the shared data beside the checkout is used unless the caller named another folder.
cmake_path(SET PARHELION_SHARED_DATA NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../../shared/data)
if(NOT DEFINED ENV{PARHELION_DATA} AND IS_DIRECTORY ${PARHELION_SHARED_DATA})
  set(ENV{PARHELION_DATA} ${PARHELION_SHARED_DATA})
endif()
