# SPDX-License-Identifier: BSD-3-Clause
# Warnings, what is compiled as one unit, and how an optional library is looked for.

# Warnings for all our own translation units, the header checks among them. They are on, and errors, only where gyrostat
# is the top-level project, and no errors in a Python wheel: a newer compiler never breaks somebody else's build.
if(PROJECT_IS_TOP_LEVEL)
  add_compile_options(-Wall -Wextra -Wpedantic -Wconversion)
  if(NOT DEFINED CMAKE_COMPILE_WARNING_AS_ERROR AND NOT SKBUILD)
    set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wshadow) # of Clang it means what stands in a namespace, too
    # false alarms inside Eigen's fixed-size products once they are inlined
    add_compile_options(-Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow)
    # the compiler looks for what it can forget after 0.6 GB, not 0.13: a tenth less time; with room for more never: a twentieth
    cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY) # MiB
    cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
    math(EXPR room "${memory} / ${cores}")
    set(heap 600000)
    if(room GREATER 3500)
      set(heap 3000000)
    endif()
    add_compile_options("SHELL:--param ggc-min-heapsize=${heap}")
    if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
      add_compile_options(-fpch-preprocess) # or ccache keeps nothing that uses a precompiled header
    endif()
  endif()
endif()

# gyrostat_unite(SOURCE...): in targets of this folder with UNITY_BUILD_MODE GROUP the sources of a family are compiled as one unit: they share
# headers and what these instantiate. What belongs to no family is with general, which knows all families.
function(gyrostat_unite)
  foreach(source IN LISTS ARGN)
    get_filename_component(name "${source}" NAME)
    if(name MATCHES "^(free|spinning|heavy|rotor|deceleration)")
      set(family "${CMAKE_MATCH_1}")
    else()
      set(family general)
    endif()
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "of_${family}")
  endforeach()
endfunction()

# Finds an optional library as its switch (AUTO, ON, OFF) says; sets <package>_FOUND.
function(gyrostat_find_optional package switch debian_name)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "VERSION" "")
  set(value "${${switch}}")
  if(NOT value OR value STREQUAL "OFF")
    set(found FALSE)
  elseif(value STREQUAL "AUTO")
    find_package(${package} ${arg_VERSION} QUIET)
    set(found ${${package}_FOUND})
  else()
    find_package(${package} ${arg_VERSION} QUIET)
    set(found ${${package}_FOUND})
    if(NOT found)
      message(FATAL_ERROR "${switch}=${value}, but ${package} >= ${arg_VERSION} was not found. "
        "On Debian: apt-get install ${debian_name}. Or configure with -D${switch}=OFF.")
    endif()
  endif()
  if(found)
    message(STATUS "gyrostat: ${package} ${${package}_VERSION} is used")
  else()
    message(STATUS "gyrostat: ${package} is not used (${switch}=${value})")
  endif()
  set(${package}_FOUND ${found} PARENT_SCOPE)
  set(${package}_VERSION "${${package}_VERSION}" PARENT_SCOPE)
endfunction()
