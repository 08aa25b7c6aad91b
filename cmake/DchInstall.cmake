# SPDX-License-Identifier: MIT
# cmake --install, find_package(dch) and pkg-config. The components say what of an installation goes together. The
# libraries of trajectories and of OpenMM have exported sets of their own, since they alone need further packages: who
# links dch::core only has to have none of them.
include(CMakePackageConfigHelpers)

set(DCH_CONFIG_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/dch)
install(EXPORT dch-targets NAMESPACE dch:: DESTINATION ${DCH_CONFIG_FOLDER} COMPONENT libdch-dev)
if(TARGET dch_shared)
  install(EXPORT dch-shared-targets NAMESPACE dch:: DESTINATION ${DCH_CONFIG_FOLDER} COMPONENT libdch-dev)
endif()
if(TARGET dch_trajectory)
  install(EXPORT dch-trajectory-targets NAMESPACE dch:: DESTINATION ${DCH_CONFIG_FOLDER} COMPONENT libdch-dev)
endif()
if(TARGET OpenMMDCH)
  install(EXPORT dch-openmm-targets NAMESPACE dch:: DESTINATION ${DCH_CONFIG_FOLDER} COMPONENT openmm-dch)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dch-config.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/dch-config.cmake
                              INSTALL_DESTINATION ${DCH_CONFIG_FOLDER})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/dch-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dch-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/dch-config-version.cmake
        DESTINATION ${DCH_CONFIG_FOLDER} COMPONENT libdch-dev)

# dch_install_pc(<name> <libraries ...>): <name>.pc, which goes by where it lies.
function(dch_install_pc name)
  set(DCH_PC_NAME ${name})
  list(TRANSFORM ARGN PREPEND -l OUTPUT_VARIABLE DCH_PC_LIBRARIES)
  list(JOIN DCH_PC_LIBRARIES " " DCH_PC_LIBRARIES)
  file(RELATIVE_PATH DCH_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /.)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/dch.pc.in ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT libdch-dev)
endfunction()

get_property(parts GLOBAL PROPERTY DCH_SHARED_PARTS)
list(REVERSE parts)  # what stands above comes first
list(TRANSFORM parts PREPEND dch_)
dch_install_pc(dch-static ${parts})
if(TARGET dch_shared)
  dch_install_pc(dch dch)
else()
  dch_install_pc(dch ${parts})
endif()

# dch_install_license(<component> [GPL] [THREE]): share/doc/<component>/copyright, in Debian's form. THREE: with three.js.
function(dch_install_license component)
  file(READ ${PROJECT_SOURCE_DIR}/LICENSE mit)
  string(REGEX REPLACE "^.*authors of dch\n\n" "" mit "${mit}")
  string(REPLACE "\n\n" "\n.\n" mit "${mit}")
  string(REGEX REPLACE "\n(.)" "\n \\1" mit " ${mit}")
  set(DCH_LICENSE Expat)
  set(DCH_OTHER_AUTHORS)
  if("THREE" IN_LIST ARGN)
    set(DCH_OTHER_AUTHORS "\n 2010-2017 three.js authors (texts in usr/bin/dchmd)")
  endif()
  set(DCH_LICENSE_TEXTS "License: Expat\n${mit}")
  if("GPL" IN_LIST ARGN)
    file(READ ${PROJECT_SOURCE_DIR}/packaging/gpl.txt gpl)
    set(DCH_LICENSE "GPL-2+ and Expat")
    string(PREPEND DCH_LICENSE_TEXTS "License: GPL-2+\n${gpl}\n")
  endif()
  set(file ${PROJECT_BINARY_DIR}/packaging/${component}/copyright)
  configure_file(${PROJECT_SOURCE_DIR}/packaging/copyright.in ${file} @ONLY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${component} COMPONENT ${component})
endfunction()

# What is installed, each component with whether it is built.
set(DCH_COMPONENTS libdch-dev)
foreach(pair IN ITEMS dch_shared:libdch dch_command:dchmd dch_python:python3-dch dch_lammps:lammps-dch OpenMMDCH:openmm-dch)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 target)
  list(GET pair 1 component)
  if(TARGET ${target})
    list(APPEND DCH_COMPONENTS ${component})
  endif()
endforeach()
foreach(component IN LISTS DCH_COMPONENTS)
  if(component STREQUAL lammps-dch)
    dch_install_license(${component} GPL)
  elseif(component STREQUAL dchmd)
    dch_install_license(${component} THREE)
  else()
    dch_install_license(${component})
  endif()
endforeach()
