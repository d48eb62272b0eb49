# SPDX-License-Identifier: GPL-3.0-or-later
# Packages for Windows, by cpack: an archive, and an installer by NSIS, both with Studio and the Blender add-on.
set(addon ${PROJECT_BINARY_DIR}/droplet-shape-blender.zip)
file(GLOB addon_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/blender/droplet_shape/*)
add_custom_command(OUTPUT ${addon} COMMAND ${CMAKE_COMMAND} -E tar cf ${addon} --format=zip droplet_shape
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/blender DEPENDS ${addon_files} VERBATIM)
add_custom_target(blender_addon ALL DEPENDS ${addon})
install(FILES ${addon} DESTINATION ${CMAKE_INSTALL_DATADIR}/droplet-shape COMPONENT command)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/src/cmake/package/copyright
  ${CMAKE_CURRENT_LIST_DIR}/libraries.txt
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/droplet-shape COMPONENT command)

set(CPACK_GENERATOR ZIP NSIS)
set(CPACK_PACKAGE_NAME droplet-shape)
set(CPACK_PACKAGE_VENDOR "The droplet-shape maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "3D droplets of liquid from the pictures of their footprints")
set(CPACK_PACKAGE_FILE_NAME droplet-shape-${PROJECT_VERSION}-windows-x86_64)
set(CPACK_PACKAGE_INSTALL_DIRECTORY droplet-shape)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
# A program of 64 bits, as those that it installs.
set(CPACK_NSIS_COMPRESSOR "lzma\n  Target amd64-unicode")
# The installer offers to put the program's folder into PATH.
set(CPACK_NSIS_MODIFY_PATH ON)
set(CPACK_NSIS_ENABLE_UNINSTALL_BEFORE_INSTALL ON)
set(CPACK_NSIS_DISPLAY_NAME "droplet-shape ${PROJECT_VERSION}")
set(CPACK_NSIS_PACKAGE_NAME droplet-shape)
set(CPACK_NSIS_MANIFEST_DPI_AWARE ON)
if(DROPLET_STUDIO)
  # The page itself: no console opens before the browser does.
  set(CPACK_NSIS_MENU_LINKS share/droplet-shape/studio.html "Droplet Studio")
endif()
include(CPack)
