# SPDX-License-Identifier: MIT
# Finds the shared library of GROMACS in single precision and defines the target Libgromacs::libgromacs.
#
# Tests and benchmarks compare with it; nothing that is installed links it.
#
# GROMACS installs a package file of its own, but it also demands the gmx program and OpenMP, which nothing here needs.
find_library(Libgromacs_LIBRARY NAMES gromacs DOC "libgromacs (Debian: libgromacs-dev)")
find_path(Libgromacs_INCLUDE_DIR NAMES gromacs/fileio/trxio.h DOC "Folder of the headers of libgromacs")

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Libgromacs REQUIRED_VARS Libgromacs_LIBRARY Libgromacs_INCLUDE_DIR)
mark_as_advanced(Libgromacs_LIBRARY Libgromacs_INCLUDE_DIR)

if(Libgromacs_FOUND AND NOT TARGET Libgromacs::libgromacs)
  add_library(Libgromacs::libgromacs UNKNOWN IMPORTED)
  set_target_properties(Libgromacs::libgromacs PROPERTIES
                        IMPORTED_LOCATION ${Libgromacs_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${Libgromacs_INCLUDE_DIR}
                        INTERFACE_COMPILE_DEFINITIONS GMX_DOUBLE=0)
endif()
