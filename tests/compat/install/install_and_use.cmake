# SPDX-License-Identifier: MIT
# Installs BUILD under FOLDER, then configures, builds and tests the project in SOURCE against what was installed.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The first C++ block of the README, so that what it shows is what is compiled.
function(extract_example readme target)
  file(READ ${readme} text)
  string(FIND "${text}" "```cpp\n" begin)
  if(begin EQUAL -1)
    message(FATAL_ERROR "${readme} has no C++ example")
  endif()
  math(EXPR begin "${begin} + 7")
  string(SUBSTRING "${text}" ${begin} -1 text)
  string(FIND "${text}" "```" end)
  string(SUBSTRING "${text}" 0 ${end} text)
  file(WRITE ${target} "${text}")
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${FOLDER}/installed)
extract_example(${README} ${FOLDER}/readme_example.cpp)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=${CONFIG}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${FOLDER}/installed
    -DDCH_COMPONENTS=${COMPONENTS} -Ddch_USE_STATIC_LIBS=${STATIC}
    -DREADME_EXAMPLE=${FOLDER}/readme_example.cpp)
run(${CMAKE_COMMAND} --build ${FOLDER}/build --config ${CONFIG})
run(${CMAKE_CTEST_COMMAND} --test-dir ${FOLDER}/build -C ${CONFIG} --output-on-failure --no-tests=error)
