# SPDX-License-Identifier: GPL-3.0-or-later
# tinygltf as scripts/package-windows builds it, without pictures.
if(NOT TARGET TinyGLTF::TinyGLTF)
  add_library(TinyGLTF::TinyGLTF STATIC IMPORTED)
  set_target_properties(TinyGLTF::TinyGLTF PROPERTIES
    IMPORTED_LOCATION ${CMAKE_CURRENT_LIST_DIR}/../../libtinygltf.a
    INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR}/../../../include)
endif()
