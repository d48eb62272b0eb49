# SPDX-License-Identifier: GPL-3.0-or-later
# Finds Clipper 6, which Debian ships without a CMake package. Defines Clipper::polyclipping.
find_path(Clipper_INCLUDE_DIR polyclipping/clipper.hpp)
find_library(Clipper_LIBRARY polyclipping)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Clipper REQUIRED_VARS Clipper_LIBRARY Clipper_INCLUDE_DIR)
if(Clipper_FOUND AND NOT TARGET Clipper::polyclipping)
  add_library(Clipper::polyclipping UNKNOWN IMPORTED)
  set_target_properties(Clipper::polyclipping PROPERTIES
    IMPORTED_LOCATION "${Clipper_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Clipper_INCLUDE_DIR}")
endif()
mark_as_advanced(Clipper_INCLUDE_DIR Clipper_LIBRARY)
