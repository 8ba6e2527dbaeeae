# SPDX-License-Identifier: BSD-3-Clause
# Finds the serial CVODE of SUNDIALS and defines CVODE::cvode, CVODE_FOUND and CVODE_VERSION.
#
# SUNDIALS' own package file asks for MPI, OpenMP, PETSc and hypre where a distribution built it with them, though the
# serial solver needs none of them; so the headers and the few libraries are found here directly.
find_path(CVODE_INCLUDE_DIR cvode/cvode.h)
set(_cvode_required CVODE_INCLUDE_DIR)
set(_cvode_libraries)
foreach(_name cvode nvecserial sunmatrixdense sunlinsoldense sunnonlinsolfixedpoint)
  find_library(CVODE_${_name}_LIBRARY sundials_${_name})
  list(APPEND _cvode_required CVODE_${_name}_LIBRARY)
  list(APPEND _cvode_libraries "${CVODE_${_name}_LIBRARY}")
endforeach()
set(CVODE_VERSION)
if(CVODE_INCLUDE_DIR AND EXISTS "${CVODE_INCLUDE_DIR}/sundials/sundials_config.h")
  file(STRINGS "${CVODE_INCLUDE_DIR}/sundials/sundials_config.h" _cvode_line
    REGEX "define SUNDIALS_VERSION \"")
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" CVODE_VERSION "${_cvode_line}")
endif()
# Since 7.0 the parts that every SUNDIALS object shares are a library of their own, and a SUNDIALS that was built with
# MPI names MPI's communicator in its context, serial or not.
if(CVODE_VERSION VERSION_GREATER_EQUAL 7)
  find_library(CVODE_core_LIBRARY sundials_core)
  list(APPEND _cvode_required CVODE_core_LIBRARY)
  list(APPEND _cvode_libraries "${CVODE_core_LIBRARY}")
  file(STRINGS "${CVODE_INCLUDE_DIR}/sundials/sundials_config.h" _cvode_line REGEX "^#define SUNDIALS_MPI_ENABLED 1")
  if(_cvode_line)
    set(MPI_CXX_SKIP_MPICXX TRUE)
    find_package(MPI QUIET COMPONENTS CXX)
    list(APPEND _cvode_required MPI_CXX_FOUND)
    list(APPEND _cvode_libraries MPI::MPI_CXX)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CVODE REQUIRED_VARS ${_cvode_required} VERSION_VAR CVODE_VERSION)
mark_as_advanced(CVODE_INCLUDE_DIR CVODE_core_LIBRARY)

if(CVODE_FOUND AND NOT TARGET CVODE::cvode)
  add_library(CVODE::cvode INTERFACE IMPORTED)
  set_target_properties(CVODE::cvode PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${CVODE_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${_cvode_libraries}"
  )
endif()
