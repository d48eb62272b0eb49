# SPDX-License-Identifier: GPL-3.0-or-later
# Tool chain of Debian's g++-mingw-w64-x86-64-posix, with libraries in DROPLET_WINDOWS; see scripts/package-windows.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES DROPLET_WINDOWS)
set(CMAKE_FIND_ROOT_PATH ${DROPLET_WINDOWS} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Windows 10 is the oldest that its maker still mends.
add_compile_definitions(_WIN32_WINNT=0x0A00 NTDDI_VERSION=0x0A000000 NOMINMAX WIN32_LEAN_AND_MEAN)
# A program needs no libraries but those of the system.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
# CMake's own list of suffixes replaces that one, and has .dll.a before .a.
set(ZLIB_LIBRARY /usr/x86_64-w64-mingw32/lib/libz.a CACHE FILEPATH "")
# Their headers ask.
add_compile_definitions(CAIRO_WIN32_STATIC_BUILD EMBREE_STATIC_LIB FRIBIDI_LIB_STATIC LIBXML_STATIC)
