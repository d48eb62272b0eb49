# SPDX-License-Identifier: GPL-3.0-or-later
# Finds HarfBuzz, whose own CMake package names the file of one version. Defines HarfBuzz::harfbuzz.
find_path(HarfBuzz_INCLUDE_DIR hb-ft.h PATH_SUFFIXES harfbuzz)
find_library(HarfBuzz_LIBRARY harfbuzz)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HarfBuzz REQUIRED_VARS HarfBuzz_LIBRARY HarfBuzz_INCLUDE_DIR)
if(HarfBuzz_FOUND AND NOT TARGET HarfBuzz::harfbuzz)
  add_library(HarfBuzz::harfbuzz UNKNOWN IMPORTED)
  set_target_properties(HarfBuzz::harfbuzz PROPERTIES
    IMPORTED_LOCATION "${HarfBuzz_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${HarfBuzz_INCLUDE_DIR}")
endif()
mark_as_advanced(HarfBuzz_INCLUDE_DIR HarfBuzz_LIBRARY)
