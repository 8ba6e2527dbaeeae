# SPDX-License-Identifier: BSD-3-Clause
# gyrostat_machine_level(VARIABLE): the highest of the levels v1, v3 and v4 of x86-64 that this machine runs; empty on another
# architecture and where the compiler cannot tell.
function(gyrostat_machine_level variable)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/machine_level.cpp" @ONLY CONTENT
    "#include \"@PROJECT_SOURCE_DIR@/python/src/cpu/level.hpp\"\nint main() { return highest_level(); }\n")
  try_run(level compiles "${PROJECT_BINARY_DIR}/machine_level" "${PROJECT_BINARY_DIR}/machine_level.cpp")
  set(found)
  if(compiles AND NOT CMAKE_CROSSCOMPILING AND level MATCHES "^[1-4]$")
    string(REPLACE "v2" "v1" found "v${level}")
    message(STATUS "gyrostat: this machine runs the instructions of x86-64-v${level}; compiled for ${found}")
  endif()
  set(${variable} "${found}" PARENT_SCOPE)
endfunction()
