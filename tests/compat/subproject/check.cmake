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
foreach(library core forces necklace)
  file(GLOB found ${FOLDER}/*/*/libdch_${library}.so.?.? ${FOLDER}/*/libdch_${library}.so.?.?)
  if(NOT found)
    message(FATAL_ERROR "libdch_${library} is no shared library with a version")
  endif()
endforeach()
file(GLOB_RECURSE others ${FOLDER}/libdch_trajectory* ${FOLDER}/dchmd ${FOLDER}/dch_unit*)
if(others)
  message(FATAL_ERROR "more than the libraries was built: ${others}")
endif()
