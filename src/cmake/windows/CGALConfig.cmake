# SPDX-License-Identifier: GPL-3.0-or-later
# CGAL's headers, with the numbers of Boost in place of GMP's.
if(NOT TARGET CGAL::CGAL)
  add_library(CGAL::CGAL INTERFACE IMPORTED)
  target_include_directories(CGAL::CGAL INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
  target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP CGAL_USE_BOOST_MP)
  target_compile_options(CGAL::CGAL INTERFACE -frounding-math)
endif()
