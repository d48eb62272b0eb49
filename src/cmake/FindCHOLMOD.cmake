# SPDX-License-Identifier: GPL-3.0-or-later
# Finds CHOLMOD, which Debian ships without a CMake package. Defines CHOLMOD::headers: the library is opened at run time.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD REQUIRED_VARS CHOLMOD_INCLUDE_DIR)
if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::headers)
  add_library(CHOLMOD::headers INTERFACE IMPORTED)
  set_target_properties(CHOLMOD::headers PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif()
mark_as_advanced(CHOLMOD_INCLUDE_DIR)
