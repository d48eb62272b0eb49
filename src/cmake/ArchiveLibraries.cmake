# SPDX-License-Identifier: GPL-3.0-or-later
# What the static libraries of scripts/archive-libraries need. Programs take of them what they use.
find_package(OpenEXR CONFIG REQUIRED)
set_property(TARGET OpenCVImages::core APPEND PROPERTY INTERFACE_LINK_LIBRARIES TBB::tbb Threads::Threads ZLIB::ZLIB ${CMAKE_DL_LIBS})
set_property(TARGET OpenCVImages::imgcodecs APPEND PROPERTY INTERFACE_LINK_LIBRARIES
  JPEG::JPEG OpenEXR::OpenEXR PNG::PNG openjp2 tiff webp)
set_target_properties(OpenMeshCore PROPERTIES IMPORTED_LOCATION_NONE ${DROPLET_ARCHIVE_LIBRARIES}/libOpenMeshCore.a)
add_link_options(LINKER:--gc-sections LINKER:--exclude-libs,ALL)
