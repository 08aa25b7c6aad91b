# SPDX-License-Identifier: GPL-2.0-or-later
# dch_check_lammps_sizes(<library>): stops if LAMMPS's library has been built with atom IDs of 64 bits. Its headers do not
# tell, but names of functions that take an ID do.
function(dch_check_lammps_sizes library)
  file(STRINGS ${library} name REGEX "_ZN9LAMMPS_NS4Atom7map_oneEl" LIMIT_COUNT 1)
  if(name)
    message(FATAL_ERROR "${library} is built with LAMMPS_BIGBIG, whose atom IDs have 64 bits. The adapter knows \
LAMMPS_SMALLBIG, the default: build LAMMPS with -D LAMMPS_SIZES=smallbig, or leave the adapter out with \
-DDCH_BUILD_LAMMPS=OFF.")
  endif()
endfunction()
