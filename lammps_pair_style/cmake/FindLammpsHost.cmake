# SPDX-License-Identifier: GPL-2.0-or-later
# The installed LAMMPS: headers, shared library and the version that both belong to, as target Lammps::host.
# Debian's LAMMPSConfig.cmake cannot be used: it wants targets of packages that it does not depend on.
find_path(LAMMPS_INCLUDE_DIR lammps/lammps.h DOC "Folder that holds lammps/lammps.h")
find_library(LAMMPS_LIBRARY lammps DOC "LAMMPS's shared library")

if(LAMMPS_LIBRARY AND NOT DCH_LAMMPS_VERSION)
  get_filename_component(_lammps_libdir ${LAMMPS_LIBRARY} DIRECTORY)
  set(_lammps_version_file ${_lammps_libdir}/cmake/LAMMPS/LAMMPSConfigVersion.cmake)
  if(EXISTS ${_lammps_version_file})
    file(STRINGS ${_lammps_version_file} _lammps_version REGEX "^set\\(PACKAGE_VERSION \"[0-9.]+\"\\)")
    # A date: "20250204", or from 2026 on "2026.7.4.0".
    if(_lammps_version MATCHES "([0-9]+)\\.([0-9]+)\\.([0-9]+)")
      math(EXPR _lammps_version "${CMAKE_MATCH_1} * 10000 + ${CMAKE_MATCH_2} * 100 + ${CMAKE_MATCH_3}")
    else()
      string(REGEX MATCH "[0-9]+" _lammps_version "${_lammps_version}")
    endif()
  endif()
endif()
set(DCH_LAMMPS_VERSION "${_lammps_version}" CACHE STRING "LAMMPS version as a number, for example 20210929")
if(NOT DCH_LAMMPS_VERSION AND _lammps_version)
  set_property(CACHE DCH_LAMMPS_VERSION PROPERTY VALUE "${_lammps_version}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  LammpsHost REQUIRED_VARS LAMMPS_LIBRARY LAMMPS_INCLUDE_DIR DCH_LAMMPS_VERSION
  REASON_FAILURE_MESSAGE "Install the package liblammps-dev, or name the parts with -DLAMMPS_INCLUDE_DIR=, \
-DLAMMPS_LIBRARY= and -DDCH_LAMMPS_VERSION=, or leave the LAMMPS adapter out with -DDCH_BUILD_LAMMPS=OFF.")

include(${CMAKE_CURRENT_LIST_DIR}/LammpsSizes.cmake)
if(LammpsHost_FOUND)
  dch_find_lammps_sizes(_lammps_sizes ${LAMMPS_LIBRARY})
endif()

# The adapter takes the place of a part of LAMMPS, hence is for a version; with these it has been run.
set(_lammps_known 20210929 20250204)
if(LammpsHost_FOUND AND NOT DCH_LAMMPS_VERSION IN_LIST _lammps_known)
  list(JOIN _lammps_known ", " _lammps_known)
  message(WARNING "The LAMMPS adapter has been run with the versions ${_lammps_known} of LAMMPS, not with \
${DCH_LAMMPS_VERSION}. If a part that it relies on has changed, the compiler stops and names it. If it does not, run \
'ctest -L lammps' before you trust the result, and see docs/lammps/install.md, \"Other versions\".")
endif()

if(LammpsHost_FOUND AND NOT TARGET Lammps::host)
  set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # the tests use these targets as well
  find_package(MPI REQUIRED COMPONENTS CXX)
  add_library(Lammps::host INTERFACE IMPORTED GLOBAL)
  # The folder shim has headers that some packages of LAMMPS lack.
  target_include_directories(Lammps::host SYSTEM INTERFACE ${LAMMPS_INCLUDE_DIR}/lammps ${CMAKE_CURRENT_LIST_DIR}/../shim)
  target_compile_definitions(Lammps::host INTERFACE ${_lammps_sizes} OMPI_SKIP_MPICXX
                                                    DCH_LAMMPS_VERSION=${DCH_LAMMPS_VERSION})
  target_link_libraries(Lammps::host INTERFACE ${LAMMPS_LIBRARY} MPI::MPI_CXX)
endif()
