# SPDX-License-Identifier: GPL-3.0-or-later
# The page that --html writes: npm brings three.js and esbuild as the lock file says, esbuild makes one script of it
# and the sources in src/page, and what comes out is compiled into the library. Sets page_parts to that source file.
set(page_dir ${PROJECT_BINARY_DIR}/page)
set(page_sources ${PROJECT_SOURCE_DIR}/src/page)
foreach(tool npm node)
  string(TOUPPER ${tool} variable)
  find_program(${variable} ${tool})
  if(NOT ${variable})
    message(FATAL_ERROR "${tool} is missing, which bundles the page that --html writes. scripts/setup installs it; "
      "-DDROPLET_PAGE=OFF builds without the page.")
  endif()
endforeach()

# npm installs beside its lock file, which must not happen in the source tree.
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
set(page_parts ${page_dir}/page_parts.cpp)
add_custom_command(
  OUTPUT ${page_parts}
  COMMAND ${NODE} ${page_sources}/bundle.mjs ${page_sources} ${page_parts}
  WORKING_DIRECTORY ${page_dir}
  DEPENDS ${page_dir}/installed ${page_files}
  COMMENT "Bundling the page")
# Its string literals are longer than every compiler must take; those we build with do.
set_source_files_properties(${page_parts} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
