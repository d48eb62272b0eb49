# SPDX-License-Identifier: GPL-3.0-or-later
# toml++ as headers alone.
set(PACKAGE_VERSION_COMPATIBLE TRUE)
if(NOT TARGET tomlplusplus::tomlplusplus)
  add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
  target_include_directories(tomlplusplus::tomlplusplus INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
endif()
