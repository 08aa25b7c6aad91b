# SPDX-License-Identifier: MIT
# Compile settings shared by every target of the project.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

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
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -ffp-contract=off)
  if(DCH_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(DCH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${DCH_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    if(DCH_SANITIZE MATCHES address.*undefined)  # AddressSanitizer sees these too; a quarter of the time to compile
      target_compile_options(${target} PRIVATE -fno-sanitize=null,object-size)
    endif()
    target_link_options(${target} PRIVATE -fsanitize=${DCH_SANITIZE})
  endif()
endfunction()
