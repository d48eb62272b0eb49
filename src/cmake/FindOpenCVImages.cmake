# SPDX-License-Identifier: GPL-3.0-or-later
# Finds OpenCV's core, imgproc and imgcodecs modules without the package of all modules.
# Defines OpenCVImages::core, OpenCVImages::imgproc, OpenCVImages::imgcodecs.
find_path(OpenCVImages_INCLUDE_DIR opencv2/imgcodecs.hpp PATH_SUFFIXES opencv4)
set(_required OpenCVImages_INCLUDE_DIR)
foreach(_module core imgproc imgcodecs)
  find_library(OpenCVImages_${_module}_LIBRARY opencv_${_module})
  list(APPEND _required OpenCVImages_${_module}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVImages REQUIRED_VARS ${_required})
if(OpenCVImages_FOUND)
  foreach(_module core imgproc imgcodecs)
    if(NOT TARGET OpenCVImages::${_module})
      add_library(OpenCVImages::${_module} UNKNOWN IMPORTED)
      set_target_properties(OpenCVImages::${_module} PROPERTIES
        IMPORTED_LOCATION "${OpenCVImages_${_module}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenCVImages_INCLUDE_DIR}")
    endif()
  endforeach()
  target_link_libraries(OpenCVImages::imgproc INTERFACE OpenCVImages::core)
  target_link_libraries(OpenCVImages::imgcodecs INTERFACE OpenCVImages::imgproc OpenCVImages::core)
endif()
mark_as_advanced(${_required})
