// SPDX-License-Identifier: GPL-2.0-or-later
#include "dch_register.h"

#include <cstdio>
#include <input.h>
#include <lammps_host.h>
#include <library.h>

#include "dch_command.h"
#include "styles.h"

namespace {

LAMMPS_NS::Command* create_command(LAMMPS_NS::LAMMPS* lmp) { return new LAMMPS_NS::DchCommand(lmp); }

void complain(const char* format, int wanted, int found) {
  int rank = 0, initialized = 0;
  MPI_Initialized(&initialized);
  if (initialized) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) std::fprintf(stderr, format, wanted, found);
}

}  // namespace

bool dch::lammps::fits_version(void* handle) {
  // Only the C function may be trusted before the versions are known to agree.
  const int version = handle ? lammps_version(handle) : 0;
  if (version == DCH_LAMMPS_VERSION) return fits_ids_of(lammps_extract_setting(handle, "tagint"));
  complain(
      "ERROR: the DCH neighbor lists were built for LAMMPS version %d, but this is version %d; build them "
      "against the headers of this LAMMPS\n",
      DCH_LAMMPS_VERSION, version);
  return false;
}

bool dch::lammps::fits_ids_of(int bytes) {
  const int known = static_cast<int>(sizeof(LAMMPS_NS::tagint));
  if (bytes == known) return true;
  complain(
      "ERROR: the DCH neighbor lists were built for LAMMPS with atom IDs of %d bytes, but this has IDs of %d "
      "bytes (its LAMMPS_SIZES); build them with -DLAMMPS_LIBRARY= the library of this LAMMPS\n",
      known, bytes);
  return false;
}

int dch_register(void* handle) {
  if (!dch::lammps::fits_version(handle)) return 1;
  auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(handle);
  lmp->input->command_map->emplace("dch", &create_command);
  LAMMPS_NS::register_styles_dch(*lmp);
  return 0;
}
