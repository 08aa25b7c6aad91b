# SPDX-License-Identifier: MIT
# Finds OpenMM with its CPU plugin and defines the targets OpenMM::host and OpenMM::cpu.
#
# Debian's packages (libopenmm-dev, libopenmm-plugins) come without a CMake package file.
find_path(OpenMM_INCLUDE_DIR NAMES openmm/cpu/CpuNeighborList.h DOC "Folder of the headers of OpenMM")
find_library(OpenMM_LIBRARY NAMES OpenMM DOC "libOpenMM")
find_library(OpenMM_CPU_LIBRARY NAMES OpenMMCPU PATH_SUFFIXES openmm/plugins DOC "OpenMM's CPU plugin")

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenMMHost REQUIRED_VARS OpenMM_LIBRARY OpenMM_CPU_LIBRARY OpenMM_INCLUDE_DIR)
mark_as_advanced(OpenMM_LIBRARY OpenMM_CPU_LIBRARY OpenMM_INCLUDE_DIR)

if(OpenMMHost_FOUND AND NOT TARGET OpenMM::host)
  add_library(OpenMM::host UNKNOWN IMPORTED)
  set_target_properties(OpenMM::host PROPERTIES IMPORTED_LOCATION ${OpenMM_LIBRARY}
                                                INTERFACE_INCLUDE_DIRECTORIES ${OpenMM_INCLUDE_DIR})
  # Its headers include those of the Reference platform without their folder.
  add_library(OpenMM::cpu UNKNOWN IMPORTED)
  set_target_properties(OpenMM::cpu PROPERTIES
                        IMPORTED_LOCATION ${OpenMM_CPU_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES
                        "${OpenMM_INCLUDE_DIR}/openmm/cpu;${OpenMM_INCLUDE_DIR}/openmm/reference"
                        INTERFACE_LINK_LIBRARIES OpenMM::host)
endif()
