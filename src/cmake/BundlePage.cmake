# SPDX-License-Identifier: GPL-3.0-or-later
# Bundles the page that --html writes. npm installs three.js and esbuild by the lock file; esbuild makes one script of
# three.js and the sources in src/html; the result is compiled into the library. Sets page_parts to that source file. The target `widget` makes
# the module that shows droplets in notebooks; sets widget_script to it.
set(page_dir ${PROJECT_BINARY_DIR}/page)
set(page_sources ${CMAKE_CURRENT_LIST_DIR}/../html)
foreach(tool npm node)
  string(TOUPPER ${tool} variable)
  find_program(${variable} ${tool})
  if(NOT ${variable})
    message(FATAL_ERROR "${tool} is missing; it is needed to bundle the page that --html writes. Install it with "
      "scripts/setup page, or build without the page with -DDROPLET_PAGE=OFF.")
  endif()
endforeach()

# npm installs beside its lock file, so the file is copied out of the source tree.
add_custom_command(
  OUTPUT ${page_dir}/installed
  COMMAND ${CMAKE_COMMAND} -E make_directory ${page_dir}
  COMMAND ${CMAKE_COMMAND} -E copy package.json package-lock.json .npmrc ${page_dir}
  COMMAND ${NPM} ci --prefix ${page_dir} --no-audit --no-fund --silent
  COMMAND ${CMAKE_COMMAND} -E touch ${page_dir}/installed
  WORKING_DIRECTORY ${page_sources}
  DEPENDS ${page_sources}/package.json ${page_sources}/package-lock.json ${page_sources}/.npmrc
  COMMENT "Fetching three.js and esbuild")

file(GLOB page_files CONFIGURE_DEPENDS ${page_sources}/*.js ${page_sources}/*.mjs ${page_sources}/*.css
  ${page_sources}/*.html)
# With Studio, the page holds its sources and solver, too.
set(page_solver)
if(DROPLET_STUDIO)
  set(page_solver ${DROPLET_STUDIO}/droplet_shape.wasm)
  file(GLOB studio_files CONFIGURE_DEPENDS ${page_sources}/../studio/* ${page_sources}/../../npm/*.js)
  list(APPEND page_files ${studio_files} ${page_solver})
endif()
set(page_parts ${page_dir}/page_parts.cpp)
add_custom_command(
  OUTPUT ${page_parts}
  COMMAND ${NODE} ${page_sources}/bundle.mjs ${page_sources} ${page_parts} ${page_solver}
  WORKING_DIRECTORY ${page_dir}
  DEPENDS ${page_dir}/installed ${page_files}
  COMMENT "Bundling the page")
# Its string literals are longer than the standard guarantees; the supported compilers accept them.
set_source_files_properties(${page_parts} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)

set(widget_script ${page_dir}/widget.js)
add_custom_command(
  OUTPUT ${widget_script}
  COMMAND ${NODE} ${page_sources}/bundle_widget.mjs ${page_sources} ${widget_script}
  WORKING_DIRECTORY ${page_dir}
  DEPENDS ${page_dir}/installed ${page_files}
  COMMENT "Bundling the widget")
add_custom_target(widget DEPENDS ${widget_script})
