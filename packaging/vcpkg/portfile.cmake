# SPDX-License-Identifier: GPL-3.0-or-later
# Port for vcpkg; not run by the project.
vcpkg_download_distfile(archive
  URLS https://droplet-shape.invalid/releases/droplet-shape-${VERSION}-source.tar.gz
  FILENAME droplet-shape-${VERSION}-source.tar.gz
  SHA512 0)
vcpkg_extract_source_archive(source ARCHIVE ${archive})
vcpkg_cmake_configure(SOURCE_PATH ${source} OPTIONS -DDROPLET_TESTS=OFF -DDROPLET_PAGE=OFF -DDROPLET_CODECS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME droplet CONFIG_PATH lib/cmake/droplet)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include ${CURRENT_PACKAGES_DIR}/debug/share)
vcpkg_install_copyright(FILE_LIST ${source}/LICENSE)
