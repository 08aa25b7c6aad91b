# SPDX-License-Identifier: MIT
# Compile settings shared by every target of the project.

if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

# dch_target_defaults(<target> [STANDARD 20])
#   Warnings, sanitizers and the floating-point contract: the predicates of the hierarchy rely on
#   |p - q|^2 being bitwise symmetric, so no contraction into fused multiply-adds and no reassociation.
#   -Wno-restrict: GCC 12 warns wrongly about "text" + std::string (GCC bug 105329); clang has no such warning.
function(dch_target_defaults target)
  cmake_parse_arguments(ARG "" "STANDARD" "" ${ARGN})
  if(NOT ARG_STANDARD)
    set(ARG_STANDARD 20)
  endif()
  target_compile_features(${target} PRIVATE cxx_std_${ARG_STANDARD})
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -ffp-contract=off)
  if(DCH_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(DCH_ASSERTIONS)
    target_compile_options(${target} PRIVATE -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  endif()
  if(DCH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${DCH_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    if(DCH_SANITIZE STREQUAL "address,undefined")
      # What comes of the first three AddressSanitizer sees too. The build `fuzz` looks for the last two. Without these two
      # sources take 0.7 of the time to compile, and tests 0.84 of theirs to run.
      target_compile_options(${target} PRIVATE -fno-sanitize=null,object-size,pointer-overflow,alignment)
    elseif(DCH_SANITIZE MATCHES address.*undefined)
      target_compile_options(${target} PRIVATE -fno-sanitize=null,object-size)
    endif()
    target_link_options(${target} PRIVATE -fsanitize=${DCH_SANITIZE})
  endif()
endfunction()

# dch_count_lines(<target>)
#   With DCH_COUNT_LINES what runs of the target is counted, on several threads too, and not of what tests it.
function(dch_count_lines target)
  if(DCH_COUNT_LINES)
    target_compile_options(${target} PRIVATE --coverage -fprofile-update=atomic)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()

# dch_join_sources(<target>)
#   With DCH_JOIN_SOURCES eight sources are compiled as one. Then a type of one of them looks like that of a header, and
#   GCC 12 inlines so much more that it warns wrongly about elements of std::initializer_list. A name that two sources of
#   a folder have, in a namespace without one, is a mistake there.
function(dch_join_sources target)
  if(DCH_JOIN_SOURCES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
    target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;-Wno-maybe-uninitialized>")
  endif()
endfunction()

# dch_optimize_less(<target>)
#   Compiles the target with -Og in builds for tests: for targets that take long to compile, which this does in two thirds
#   of the time, and little time to run.
function(dch_optimize_less target)
  if(DCH_ASSERTIONS OR DCH_SANITIZE)
    target_compile_options(${target} PRIVATE -Og)
  endif()
endfunction()

# dch_instruction_sets(<target>)
#   The inner loops once for each instruction set, each in a source file whose name ends with that of the set; which one
#   runs is decided at run time. Those of other processors are not compiled.
function(dch_instruction_sets target)
  get_target_property(sources ${target} SOURCES)
  set(of_x86 ${sources})
  list(FILTER of_x86 INCLUDE REGEX "_(sse42|avx2|avx512)\\.cpp$")
  set(portable ${sources})
  list(FILTER portable INCLUDE REGEX "_portable\\.cpp$")
  # GCC notes that vectors of 256 bits are passed in another way where the processor has them; nothing here is called
  # from outside.
  set_property(SOURCE ${portable} APPEND PROPERTY COMPILE_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>)
  set(of_neon ${sources})
  list(FILTER of_neon INCLUDE REGEX "_neon\\.cpp$")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$")
    target_compile_definitions(${target} PRIVATE DCH_NEON_KERNELS)
    set_property(SOURCE ${of_neon} APPEND PROPERTY COMPILE_DEFINITIONS DCH_NEON_SET)
  else()
    set_property(SOURCE ${of_neon} PROPERTY HEADER_FILE_ONLY ON)
  endif()
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    set_property(SOURCE ${of_x86} PROPERTY HEADER_FILE_ONLY ON)
    return()
  endif()
  target_compile_definitions(${target} PRIVATE DCH_X86_KERNELS)
  set(sse42 -msse4.2 -mpopcnt)
  set(avx2 -mavx2 -mfma -mbmi -mbmi2 -mpopcnt)
  set(avx512 ${avx2} -mavx512f -mavx512bw -mavx512vl -mavx512dq -mavx512vbmi2)
  foreach(set sse42 avx2 avx512)
    set(of_set ${of_x86})
    list(FILTER of_set INCLUDE REGEX "_${set}\\.cpp$")
    set_property(SOURCE ${of_set} APPEND PROPERTY COMPILE_OPTIONS ${${set}})
    if(NOT set STREQUAL sse42)
      # GCC 12 takes the undefined registers of its own intrinsics for mistakes (GCC bug 105593).
      set_property(SOURCE ${of_set} APPEND PROPERTY COMPILE_OPTIONS
                   $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> -Wno-uninitialized)
    endif()
  endforeach()
endfunction()

# dch_add_library(<name> [EXPORT set])
#   The static library dch_<name> of all sources in src/, with its headers in include/, to be installed; and
#   dch_<name>_internals, what is no part of its interface, for the other libraries, the tests and benchmarks of this
#   project. Without an export set of its own it is a part of libdch (cmake/DchShared.cmake) too, from the same objects.
#   dch::<name> is the static library, but in a project that takes this one in with BUILD_SHARED_LIBS it is libdch.
function(dch_add_library name)
  cmake_parse_arguments(ARG "" "EXPORT" "" ${ARGN})
  set(target dch_${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  add_library(${target} STATIC ${sources})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME ${target})
  if(ARG_EXPORT)
    add_library(dch::${name} ALIAS ${target})
  else()
    set(ARG_EXPORT dch-targets)
    if(NOT DCH_LINK_SHARED)
      add_library(dch::${name} ALIAS ${target})
    endif()
    set_property(GLOBAL APPEND PROPERTY DCH_SHARED_PARTS ${name})
    # Public headers make what they declare visible, between pragmas.
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                                       PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_features(${target} PUBLIC cxx_std_17)
  dch_target_defaults(${target})
  dch_join_sources(${target})
  add_library(${target}_internals INTERFACE)
  target_include_directories(${target}_internals INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  install(TARGETS ${target} EXPORT ${ARG_EXPORT} COMPONENT libdch-dev)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libdch-dev)
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/moved)
    install(DIRECTORY moved/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libdch-dev)
  endif()
endfunction()
