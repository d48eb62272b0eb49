# SPDX-License-Identifier: GPL-3.0-or-later
# What each kind of package holds.
set(CPACK_COMPONENTS_ALL command)
if(CPACK_GENERATOR STREQUAL "TGZ")
  list(APPEND CPACK_COMPONENTS_ALL bundle)
  set(CPACK_CUSTOM_INSTALL_VARIABLES has_loader=ON)
endif()
