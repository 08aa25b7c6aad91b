# SPDX-License-Identifier: GPL-2.0-or-later
# dch_find_lammps_sizes(<variable> <library>): what LAMMPS's headers have to be read with, LAMMPS_BIGBIG if its library has
# been built with atom IDs of 64 bits, else LAMMPS_SMALLBIG. The headers do not tell, but names of functions that take an
# ID do.
function(dch_find_lammps_sizes variable library)
  file(STRINGS ${library} name REGEX "_ZN9LAMMPS_NS4Atom7map_oneEl" LIMIT_COUNT 1)
  if(name)
    set(${variable} LAMMPS_BIGBIG PARENT_SCOPE)
  else()
    set(${variable} LAMMPS_SMALLBIG PARENT_SCOPE)
  endif()
endfunction()
