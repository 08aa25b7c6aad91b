# SPDX-License-Identifier: MIT
# What an installed tree needs to be a Debian package; CPack runs it between the two, with a folder for each component.
# Python's modules go where Debian's packages have them, for any version of Python 3, and folders that are found from where a
# file lies are as far away as before.
file(GLOB trees LIST_DIRECTORIES true ${CPACK_TEMPORARY_DIRECTORY}/*)
foreach(tree IN LISTS trees)
  if(NOT IS_DIRECTORY ${tree}/usr)
    continue()
  endif()
  get_filename_component(package ${tree} NAME)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/../packaging/changelog ${tree}/usr/share/doc/${package}/changelog.Debian
                 COPYONLY)
  file(GLOB pages ${tree}/usr/share/doc/${package}/changelog.Debian ${tree}/usr/share/man/*/*)
  foreach(page IN LISTS pages)
    execute_process(COMMAND gzip -9n ${page} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  file(GLOB versioned ${tree}/usr/lib/python3.*)
  if(versioned)
    file(RENAME ${versioned} ${tree}/usr/lib/python3)
  endif()
  file(REMOVE ${tree}/usr/share/dch/lammps/LICENSE)  # in /usr/share/common-licenses

  # A package may name folders of libraries only by where its own files lie.
  file(RELATIVE_PATH folder /usr/lib/openmm_dch/plugins ${CPACK_DCH_OPENMM_CPU_FOLDER})
  file(GLOB plugins ${tree}/usr/lib/openmm_dch/plugins/*.so)
  foreach(plugin IN LISTS plugins)
    file(RPATH_CHANGE FILE ${plugin} OLD_RPATH "$ORIGIN/../..:${CPACK_DCH_OPENMM_CPU_FOLDER}" NEW_RPATH "$ORIGIN/${folder}")
  endforeach()
endforeach()
