# SPDX-License-Identifier: GPL-2.0-or-later
# The package DCH, whose sources in src/DCH stand on the libraries in lib/dch.
string(TOLOWER "${LAMMPS_SIZES}" DCH_SIZES)
if(NOT DCH_SIZES STREQUAL "smallbig")
  message(FATAL_ERROR "The package DCH knows atom IDs of 32 bits: give -D LAMMPS_SIZES=smallbig, the default, not \
${LAMMPS_SIZES}, or -D PKG_DCH=off")
endif()
add_subdirectory(${LAMMPS_LIB_SOURCE_DIR}/dch ${CMAKE_CURRENT_BINARY_DIR}/dch EXCLUDE_FROM_ALL)
target_link_libraries(lammps PRIVATE dch::necklace dch::forces)
if(NOT BUILD_SHARED_LIBS)
  install(TARGETS dch_core dch_necklace dch_forces EXPORT LAMMPS_Targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()

# Headers of styles are C++17. Positions are compared bit by bit: no contraction of multiplications and additions.
target_compile_features(lammps PRIVATE cxx_std_17)
file(GLOB DCH_SOURCES ${LAMMPS_SOURCE_DIR}/DCH/[^.]*.cpp)
set_source_files_properties(${DCH_SOURCES} PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
