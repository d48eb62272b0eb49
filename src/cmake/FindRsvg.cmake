# SPDX-License-Identifier: GPL-3.0-or-later
# Finds librsvg. Defines PkgConfig::Rsvg, with GLib and Cairo.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Rsvg QUIET IMPORTED_TARGET librsvg-2.0>=2.52)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Rsvg REQUIRED_VARS Rsvg_INCLUDE_DIRS VERSION_VAR Rsvg_VERSION)
