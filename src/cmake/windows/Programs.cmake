# SPDX-License-Identifier: GPL-3.0-or-later
# What a program has on Windows: a manifest, its version, and a stack as deep as on Linux.
enable_language(RC)
configure_file(${CMAKE_CURRENT_LIST_DIR}/program.rc.in ${PROJECT_BINARY_DIR}/program.rc @ONLY)
function(windows_program target)
  target_sources(${target} PRIVATE ${PROJECT_BINARY_DIR}/program.rc)
  target_link_options(${target} PRIVATE LINKER:--stack,8388608)
  target_link_libraries(${target} PRIVATE psapi shell32)
endfunction()
