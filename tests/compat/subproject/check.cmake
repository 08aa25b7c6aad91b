# SPDX-License-Identifier: MIT
# Builds the project in SOURCE, which takes in that in DCH, under FOLDER, and looks at what has become of it.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DDCH=${DCH}
    -DBUILD_SHARED_LIBS=ON)
run(${CMAKE_COMMAND} --build ${FOLDER} --parallel 2)
run(${FOLDER}/program)

load_cache(${FOLDER} READ_WITH_PREFIX OF_PARENT_ CMAKE_BUILD_TYPE BUILD_TESTING)
if(OF_PARENT_CMAKE_BUILD_TYPE OR DEFINED OF_PARENT_BUILD_TESTING)
  message(FATAL_ERROR "the parent's build type or its tests were changed")
endif()
if(NOT EXISTS ${FOLDER}/dch/libdch.so.0.1)
  message(FATAL_ERROR "libdch is no shared library with a version")
endif()
execute_process(COMMAND readelf -d ${FOLDER}/program OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
if(NOT needed MATCHES "libdch\\.so\\.0\\.1")
  message(FATAL_ERROR "the program does not link it: ${needed}")
endif()
file(GLOB_RECURSE others ${FOLDER}/libdch_trajectory* ${FOLDER}/dchmd ${FOLDER}/dch_unit*)
if(others)
  message(FATAL_ERROR "more than the libraries was built: ${others}")
endif()
