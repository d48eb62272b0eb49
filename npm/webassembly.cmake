# SPDX-License-Identifier: GPL-3.0-or-later
# What all modules have in common; `root` is the folder of the project.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
# Exceptions and vectors of WebAssembly itself: every browser has had them since 2023. Exceptions by JavaScript cost much
# time.
add_compile_options(-fwasm-exceptions -sSUPPORT_LONGJMP=wasm -msimd128 -O3 -ffp-contract=off)

# Headers of libraries that are headers alone, without the system's C library beside them.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
function(link_headers)
  foreach(library ${ARGN})
    find_path(folder_of_${library} ${library} PATHS /usr/include /usr/include/eigen3 NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
    file(CREATE_LINK ${folder_of_${library}}/${library} ${headers}/${library} SYMBOLIC)
  endforeach()
endfunction()

# For sources of the project. Eigen takes its instructions of SSE2: see npm/src/mmintrin.h.
set(own_options -msse2 -Wall -Wextra -Wpedantic -Wno-unknown-pragmas -include ${root}/npm/src/standard_library.h)

# add_c_module(NAME SOURCE...): the C interface as a module of its own.
function(add_c_module name)
  add_executable(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES SUFFIX .wasm)
  target_include_directories(${name} PRIVATE ${root}/include ${root}/src ${root}/c/src ${root}/npm/src)
  target_include_directories(${name} SYSTEM PRIVATE ${headers})
  target_compile_definitions(${name} PRIVATE FMT_HEADER_ONLY)
  # Clang 14 makes wrong vectors of similar code: see CMakeLists.txt.
  target_compile_options(${name} PRIVATE ${own_options} -fno-slp-vectorize)
  target_link_options(${name} PRIVATE
    -fwasm-exceptions -sSUPPORT_LONGJMP=wasm --no-entry -sSTANDALONE_WASM -sALLOW_MEMORY_GROWTH -sMAXIMUM_MEMORY=2GB -sTOTAL_STACK=1MB
    -sFILESYSTEM=0 -sEXPORTED_FUNCTIONS=_malloc,_free -O3)
endfunction()
