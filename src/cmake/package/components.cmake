# SPDX-License-Identifier: GPL-3.0-or-later
# What each kind of package holds.
set(CPACK_COMPONENTS_ALL command)
if(CPACK_GENERATOR STREQUAL "TGZ")
  list(APPEND CPACK_COMPONENTS_ALL bundle)
  set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/launch_programs.cmake)
endif()
