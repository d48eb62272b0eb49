# SPDX-License-Identifier: GPL-3.0-or-later
# What static libraries need of one another, which on Linux the shared ones say themselves.
function(needs library)
  set_property(TARGET ${library} APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${ARGN})
endfunction()
needs(Freetype::Freetype PNG::PNG ZLIB::ZLIB)
needs(HarfBuzz::harfbuzz Freetype::Freetype)
needs(Cairo::cairo pixman-1)
needs(Embree::Embree embree_sse42 lexers simd math sys tasking)
needs(OpenCVImages::imgcodecs tiff webp)
needs(OpenCVImages::core ZLIB::ZLIB)
link_directories(${DROPLET_WINDOWS}/lib)
