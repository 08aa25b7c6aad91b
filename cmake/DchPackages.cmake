# SPDX-License-Identifier: MIT
# Debian packages by CPack, one for each component of the installation (scripts/package). What a library needs dpkg-shlibdeps
# finds out; named here is what it cannot see.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dch)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The authors of dch <maintainers@users.noreply.github.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL ${DCH_COMPONENTS})
get_cmake_property(unpacked COMPONENTS)
list(REMOVE_ITEM unpacked ${DCH_COMPONENTS})
if(unpacked)
  message(FATAL_ERROR "Installed, but in no package: the components ${unpacked}. Give install() one of ${DCH_COMPONENTS}")
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/DchDebianTree.cmake)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# dch_describe_package(<component> SECTION <section> DEPENDS <packages> [SUGGESTS <packages>] [CONTROL <files>]
#                      SUMMARY <line> TEXT <text>)
function(dch_describe_package component)
  cmake_parse_arguments(ARG "" "SECTION;DEPENDS;SUGGESTS;SUMMARY;TEXT" "CONTROL" ${ARGN})
  string(TOUPPER ${component} upper)
  string(REGEX REPLACE "(.................................................................[^ ]*) " "\\1\n" ARG_TEXT "${ARG_TEXT}")
  set(control)
  foreach(file IN LISTS ARG_CONTROL)
    get_filename_component(name ${file} NAME)
    configure_file(${PROJECT_SOURCE_DIR}/packaging/control/${file} ${PROJECT_BINARY_DIR}/packaging/${component}/${name} @ONLY)
    list(APPEND control ${PROJECT_BINARY_DIR}/packaging/${component}/${name})
  endforeach()
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${ARG_SECTION} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${ARG_DEPENDS}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS "${ARG_SUGGESTS}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${control}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${ARG_SUMMARY}\n${ARG_TEXT}" PARENT_SCOPE)
endfunction()

# dch_same_upstream(<result> <library>): the package that owns this file, in the upstream version that is installed, whatever
# Debian's revision. What a plugin takes from the inside of its host, another version may have otherwise.
function(dch_same_upstream result library)
  file(REAL_PATH ${library} library)
  execute_process(COMMAND ${DPKG_QUERY} --search ${library} OUTPUT_VARIABLE owner RESULT_VARIABLE status ERROR_QUIET)
  if(NOT status EQUAL 0)
    set(${result} "" PARENT_SCOPE)  # built by hand
    return()
  endif()
  string(REGEX REPLACE ":.*" "" owner ${owner})
  execute_process(COMMAND ${DPKG_QUERY} --show --showformat \${source:Upstream-Version} ${owner} OUTPUT_VARIABLE version
                  COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${owner} (>= ${version}), ${owner} (<< ${version}.0~), " PARENT_SCOPE)
endfunction()

set(text "A neighbor list says which particles are within a cutoff of each other. This library makes it by a discrete center \
hierarchy that is repaired as particles move, in any periodic box, at any density and any ratio of sizes. It also has forces \
on such lists, nearest neighbors, spanning trees, hard spheres, zonotopes and contacts and crossings of chains.")
dch_describe_package(libdch SECTION libs CONTROL triggers libdch/shlibs
                     SUMMARY "neighbor lists for molecular dynamics - shared library" TEXT "${text}")
dch_describe_package(libdch-dev SECTION libdevel DEPENDS "libdch (= ${PROJECT_VERSION}-1), libfmt-dev, libhdf5-dev, zlib1g-dev"
                     SUMMARY "neighbor lists for molecular dynamics - development files"
                     TEXT "${text}\n\nHeaders, static libraries, and files for CMake and pkg-config. The readers of trajectories, \
which need the packages of HDF5, zlib and fmt, are a static library alone.")
dch_describe_package(dchmd SECTION science SUMMARY "neighbor lists, contacts and crossings of trajectories"
                     TEXT "The command dchmd reads trajectories of LAMMPS, GROMACS, DCD and H5MD, makes the neighbor list of each \
frame and checks it pair by pair, follows contacts of polymer chains, finds bonds that pass through each other, and runs \
hard spheres.")

find_package(Python3 REQUIRED COMPONENTS Interpreter)
math(EXPR next "${Python3_VERSION_MINOR} + 1")
set(python "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next})")
if(TARGET dch_python)
  dch_describe_package(python3-dch SECTION python CONTROL python/postinst python/prerm
                       DEPENDS "${python}, python3-numpy"
                       SUGGESTS "python3-ase, python3-mdanalysis, python3-openmm | python3-simtk"
                       SUMMARY "neighbor lists for molecular dynamics - Python module"
                       TEXT "The module dch has neighbor lists that are called as those of ASE and matscipy, lists that follow \
particles that move, nearest neighbors, and crossings of bonds, as numpy arrays.")
endif()
if(TARGET dch_lammps)
  dch_same_upstream(lammps ${LAMMPS_LIBRARY})
  dch_describe_package(lammps-dch SECTION science CONTROL triggers DEPENDS "${lammps}python3" SUGGESTS "lammps"
                       SUMMARY "neighbor lists and force styles of dch for LAMMPS"
                       TEXT "Has a stock LAMMPS run on neighbor lists from a discrete center hierarchy: the launcher lmp-dch and \
a file to include in scripts. It has force styles on these lists and contacts and crossings of chains.")
endif()
if(TARGET OpenMMDCH)
  get_filename_component(CPACK_DCH_OPENMM_CPU_FOLDER ${OpenMM_CPU_LIBRARY} DIRECTORY)
  dch_same_upstream(openmm ${OpenMM_LIBRARY})
  dch_describe_package(openmm-dch SECTION science CONTROL triggers python/postinst python/prerm
                       DEPENDS "${openmm}libopenmm-plugins, ${python}, python3-openmm | python3-simtk" SUGGESTS libdch-dev
                       SUMMARY "nonbonded forces of OpenMM on neighbor lists of dch"
                       TEXT "The Python package openmm_dch takes over the nonbonded forces of OpenMM's CPU and Reference \
platforms, with neighbor lists from a discrete center hierarchy. It also has a repulsion where chains of beads touch.")
endif()
include(CPack)
