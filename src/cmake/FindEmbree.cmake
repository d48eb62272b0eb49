# SPDX-License-Identifier: GPL-3.0-or-later
# Finds Embree 4 or 3, which Debian ships without a CMake package. Defines Embree::Embree, whose header is <rtcore.h>.
find_path(Embree_HEADERS rtcore.h PATH_SUFFIXES embree4 embree3)
cmake_path(GET Embree_HEADERS FILENAME Embree_NAME)
find_library(Embree_LIBRARY NAMES ${Embree_NAME})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Embree REQUIRED_VARS Embree_LIBRARY Embree_HEADERS)
if(Embree_FOUND AND NOT TARGET Embree::Embree)
  add_library(Embree::Embree UNKNOWN IMPORTED)
  set_target_properties(Embree::Embree PROPERTIES
    IMPORTED_LOCATION "${Embree_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Embree_HEADERS}")
endif()
mark_as_advanced(Embree_HEADERS Embree_LIBRARY)
