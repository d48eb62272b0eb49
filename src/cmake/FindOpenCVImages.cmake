# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the OpenCV modules imgproc and imgcodecs, as components, without the package of all modules.
# Defines OpenCVImages::core, OpenCVImages::imgproc, OpenCVImages::imgcodecs, each if it is found.
find_path(OpenCVImages_INCLUDE_DIR opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
mark_as_advanced(OpenCVImages_INCLUDE_DIR)
set(_below)
foreach(_module core imgproc imgcodecs)
  find_library(OpenCVImages_${_module}_LIBRARY opencv_${_module})
  mark_as_advanced(OpenCVImages_${_module}_LIBRARY)
  if(OpenCVImages_INCLUDE_DIR AND OpenCVImages_${_module}_LIBRARY)
    set(OpenCVImages_${_module}_FOUND TRUE)
    if(NOT TARGET OpenCVImages::${_module})
      add_library(OpenCVImages::${_module} UNKNOWN IMPORTED)
      set_target_properties(OpenCVImages::${_module} PROPERTIES
        IMPORTED_LOCATION "${OpenCVImages_${_module}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenCVImages_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${_below}")
    endif()
    list(APPEND _below OpenCVImages::${_module})
  endif()
endforeach()
unset(_below)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVImages
  REQUIRED_VARS OpenCVImages_core_LIBRARY OpenCVImages_INCLUDE_DIR HANDLE_COMPONENTS)
