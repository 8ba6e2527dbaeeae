# SPDX-License-Identifier: BSD-3-Clause
# cmake -DKIND=... -DSOURCE_DIR=... -DBINARY_DIR=... -P run.cmake: configure, build and test one outside project.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(work "${BINARY_DIR}/packaging/${KIND}")
file(REMOVE_RECURSE "${work}")
set(options -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" -DCMAKE_BUILD_TYPE=Debug)
if(KIND STREQUAL "find_package")
  # installed, then moved: the package must not remember where it was built or first put
  run("${CMAKE_COMMAND}" --install "${BINARY_DIR}" --prefix "${work}/first")
  file(RENAME "${work}/first" "${work}/prefix")
  list(APPEND options "-DCMAKE_PREFIX_PATH=${work}/prefix" "-DGYROSTAT_OPTIONAL=${OPTIONAL}")
else()
  list(APPEND options "-DGYROSTAT_SOURCE_DIR=${SOURCE_DIR}" -DGYROSTAT_GSL=OFF -DGYROSTAT_CVODE=OFF)
endif()
run("${CMAKE_COMMAND}" -S "${SOURCE_DIR}/tests/packaging/${KIND}" -B "${work}/build" ${options})
run("${CMAKE_COMMAND}" --build "${work}/build" --parallel 2)
run("${CMAKE_CTEST_COMMAND}" --test-dir "${work}/build" --output-on-failure --no-tests=error)
