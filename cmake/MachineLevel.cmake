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
    message(STATUS "gyrostat: this machine runs the instructions of x86-64-v${level}")
  endif()
  set(${variable} "${found}" PARENT_SCOPE)
endfunction()

# gyrostat_level_options(VARIABLE LEVEL): how the compiler is told to compile for v1, v3 or v4.
function(gyrostat_level_options variable level)
  string(REPLACE "x86-64-v1" "x86-64" architecture "x86-64-${level}")
  set(options -march=${architecture})
  if(level STREQUAL "v4")
    # Registers of 256 bits are full with the four numbers that the integrators work on; wider ones made v4 slower than v3. And GCC copies
    # objects through wide registers and leaves their upper halves in use (no vzeroupper), which slows down what libm has for SSE: the
    # closed form of a free motion took half as long again.
    list(APPEND options -mprefer-vector-width=256)
    include(CheckCXXCompilerFlag)
    check_cxx_compiler_flag("-mmove-max=128 -mstore-max=128" GYROSTAT_HAS_MOVE_MAX)
    if(GYROSTAT_HAS_MOVE_MAX)
      list(APPEND options -mmove-max=128 -mstore-max=128)
    endif()
  endif()
  set(${variable} ${options} PARENT_SCOPE)
endfunction()
