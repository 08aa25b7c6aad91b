# SPDX-License-Identifier: MIT
# Installs BUILD under FOLDER/installed, and puts beside it what the scripts of tests/golden/lammps expect in one folder.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${FOLDER}/installed
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${FOLDER}/installed/${BIN}/dchmd generate melt --chains 20 --beads 60 ${FOLDER}/melt.data
                COMMAND_ERROR_IS_FATAL ANY)
file(MAKE_DIRECTORY ${FOLDER}/lammps)
foreach(file ${BIN}/lmp-dch ${SHARE}/dch.lmp ${LIB}/libdch_lammps.so)
  get_filename_component(name ${file} NAME)
  file(CREATE_LINK ${FOLDER}/installed/${file} ${FOLDER}/lammps/${name} SYMBOLIC)
endforeach()
