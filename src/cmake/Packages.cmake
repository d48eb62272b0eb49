# SPDX-License-Identifier: GPL-3.0-or-later
# Packages of the command, by cpack: a .deb for the release of Debian it was built on, and an archive that runs wherever
# it is unpacked, on any distribution, with all libraries.
set(documents ${CMAKE_INSTALL_DATADIR}/doc/droplet-shape)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/package/copyright DESTINATION ${documents} COMPONENT command)
execute_process(COMMAND date --utc --rfc-email --date=${released} OUTPUT_VARIABLE package_date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
configure_file(${CMAKE_CURRENT_LIST_DIR}/package/changelog.in changelog @ONLY)
add_custom_command(OUTPUT changelog.Debian.gz
  COMMAND gzip -9 --no-name --stdout changelog > changelog.Debian.gz DEPENDS ${PROJECT_BINARY_DIR}/changelog VERBATIM)
add_custom_target(package_changelog DEPENDS changelog.Debian.gz)
add_dependencies(droplet-shape package_changelog)
install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian.gz DESTINATION ${documents} COMPONENT command)

install(FILES ${CMAKE_CURRENT_LIST_DIR}/package/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
  RENAME droplet-shape COMPONENT command)

# The archive has the C library and its loader, too, which run on every kernel of Linux since 3.2. A small program without
# libraries starts each of its programs through them; see cli/launch.
set(own_data)
if(DROPLET_ARCHIVE_LIBRARIES)
  file(GLOB icu_data CONFIGURE_DEPENDS ${DROPLET_ARCHIVE_LIBRARIES}/libicudata.so.*)
  install(PROGRAMS ${icu_data} DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT bundle EXCLUDE_FROM_ALL)
  set(own_data PRE_EXCLUDE_REGEXES ^libicudata\\.)
endif()
install(RUNTIME_DEPENDENCY_SET droplet_runtime ${own_data} DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT bundle EXCLUDE_FROM_ALL
  PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
add_executable(droplet_launch ${PROJECT_SOURCE_DIR}/cli/launch/launch.cpp)
target_compile_features(droplet_launch PRIVATE cxx_std_20)
set(loader_of_x86_64 ld-linux-x86-64.so.2)
set(loader_of_aarch64 ld-linux-aarch64.so.1)
target_compile_definitions(droplet_launch PRIVATE DROPLET_LIBRARIES="${CMAKE_INSTALL_LIBDIR}" DROPLET_LOADER="${loader_of_${CMAKE_SYSTEM_PROCESSOR}}")
target_link_libraries(droplet_launch PRIVATE droplet_flags)
target_compile_options(droplet_launch PRIVATE -fno-sanitize=all)
target_link_options(droplet_launch PRIVATE -static -fno-sanitize=all)
install(CODE "
  set(strip \"${CMAKE_STRIP}\")
  set(launch \"${PROJECT_BINARY_DIR}/droplet_launch\")
  set(launched ${CMAKE_INSTALL_BINDIR}/droplet-shape $<$<NOT:$<BOOL:${DROPLET_ONE_PROGRAM}>>:${CMAKE_INSTALL_LIBDIR}/${private}/droplet-motion>
    ${CMAKE_INSTALL_LIBDIR}/${private}/droplet-svg)" COMPONENT command)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/package/launch_programs.cmake COMPONENT command)

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME droplet-shape)
set(CPACK_PACKAGE_CONTACT "The droplet-shape maintainers <maintainers@droplet-shape.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "3D droplets of liquid from the pictures of their footprints")
set(CPACK_PACKAGE_DESCRIPTION "\
The command turns a mask, a logo, a glyph or a drawing into the mesh of the
droplet that surface tension and gravity shape on it, as glTF, OBJ, PLY or STL.
.
It fills whole fonts and folders of masks, renders droplets, and animates
droplets in wind tunnels, on windshields and over meshes.
.
Droplet Studio, an editor in the browser, shows the droplet of a footprint
while it is drawn.")
set(CPACK_PACKAGE_FILE_NAME droplet-shape-${PROJECT_VERSION}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(CMAKE_CROSSCOMPILING)
  set(debian_aarch64 arm64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${debian_${CMAKE_SYSTEM_PROCESSOR}})
endif()
# xdg-open opens Studio.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS xdg-utils)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/package/components.cmake)
include(CPack)
