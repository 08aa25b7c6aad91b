# SPDX-License-Identifier: MIT
# Installs the libraries of BUILD under FOLDER, compiles a program with what pkg-config says of dch and of dch-static, runs
# both, and looks at what the shared library shows.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
foreach(component IN ITEMS libdch libdch-dev)
  run(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${FOLDER} --component ${component})
endforeach()
set(ENV{PKG_CONFIG_PATH} ${FOLDER}/${LIB}/pkgconfig)
foreach(package IN ITEMS dch dch-static)
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs "${package} >= 0.1" OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${COMPILER} -std=c++17 -o ${FOLDER}/${package} ${SOURCE} ${flags})
endforeach()
run(${FOLDER}/dch-static)
execute_process(COMMAND ${FOLDER}/dch RESULT_VARIABLE status ERROR_QUIET)
if(status EQUAL 0)
  message(FATAL_ERROR "the program runs without libdch.so, so it was not linked with it")
endif()
run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${FOLDER}/${LIB} ${FOLDER}/dch)
run(${PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/check_symbols.py ${FOLDER}/${LIB}/libdch.so ${FOLDER}/${INCLUDE})
