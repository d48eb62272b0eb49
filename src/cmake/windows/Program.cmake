# SPDX-License-Identifier: GPL-3.0-or-later
# What the program has on Windows: a manifest, its version, and a stack as deep as on Linux.
enable_language(RC)
configure_file(${CMAKE_CURRENT_LIST_DIR}/program.rc.in ${PROJECT_BINARY_DIR}/program.rc @ONLY)
target_sources(droplet-shape PRIVATE ${PROJECT_BINARY_DIR}/program.rc windows/c_library/multibyte.cpp
  windows/c_library/thread_precision.cpp)
target_link_options(droplet-shape PRIVATE LINKER:--stack,8388608)
target_link_libraries(droplet-shape PRIVATE psapi shell32)
