# SPDX-License-Identifier: BSD-3-Clause
# find_package(gyrostat [COMPONENTS headers gyrostat gsl cvode]) by the Python package. That carries the sources, not a library:
# they become a part of the project that asks, which compiles of them what it links, with its own compiler and options.
if(NOT TARGET gyrostat::headers)
  add_subdirectory("${CMAKE_CURRENT_LIST_DIR}/../../../cpp" "${CMAKE_BINARY_DIR}/_gyrostat" EXCLUDE_FROM_ALL)
endif()
foreach(_component IN LISTS gyrostat_FIND_COMPONENTS)
  set(gyrostat_${_component}_FOUND FALSE)
  if(TARGET gyrostat::${_component})
    set(gyrostat_${_component}_FOUND TRUE)
  elseif(gyrostat_FIND_REQUIRED_${_component})
    set(gyrostat_FOUND FALSE)
    set(gyrostat_NOT_FOUND_MESSAGE "gyrostat has no component ${_component}, or the library that it needs was not found")
  endif()
endforeach()
