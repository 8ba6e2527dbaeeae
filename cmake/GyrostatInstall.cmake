# SPDX-License-Identifier: BSD-3-Clause
# Install rules: every component is an export set of its own, so that find_package(gyrostat COMPONENTS ...) loads the
# optional libraries only for who asks for them.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gyrostat")

install(TARGETS gyrostat_headers EXPORT gyrostat-headers FILE_SET HEADERS)
install(TARGETS gyrostat EXPORT gyrostat-gyrostat FILE_SET HEADERS)
set(components headers gyrostat)
if(TARGET gyrostat_gsl)
  install(TARGETS gyrostat_gsl EXPORT gyrostat-gsl FILE_SET HEADERS)
  list(APPEND components gsl)
endif()
if(TARGET gyrostat_cvode)
  install(TARGETS gyrostat_cvode EXPORT gyrostat-cvode FILE_SET HEADERS)
  list(APPEND components cvode)
endif()
foreach(component IN LISTS components)
  install(EXPORT gyrostat-${component} NAMESPACE gyrostat:: DESTINATION "${package_dir}")
endforeach()

configure_package_config_file(cmake/gyrostat-config.cmake.in "${PROJECT_BINARY_DIR}/gyrostat-config.cmake"
  INSTALL_DESTINATION "${package_dir}"
)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/gyrostat-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${PROJECT_BINARY_DIR}/gyrostat-config.cmake"
    "${PROJECT_BINARY_DIR}/gyrostat-config-version.cmake"
    cmake/FindCVODE.cmake
  DESTINATION "${package_dir}"
)

file(RELATIVE_PATH pc_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
set(pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}")
set(pc_libdir "libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}")
set(pc_definitions " -DGYROSTAT_COMPILED=1")
set(pc_libraries " -L\${libdir} -lgyrostat")
# what a C compiler that links the library has to be told: the libraries that the C++ compiler links by itself
set(pc_private ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER pc_private INCLUDE REGEX "^(m|.*c\\+\\+.*)$")
list(TRANSFORM pc_private PREPEND " -l")
list(JOIN pc_private "" pc_private)
configure_file(cmake/gyrostat.pc.in "${PROJECT_BINARY_DIR}/gyrostat.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/gyrostat.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/gyrostat")
