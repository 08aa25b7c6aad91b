// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_dch_work.h"

#include <error.h>
#include <modify.h>
#include <update.h>

#include "fix_dch_work.h"
#include "neighbor_dch.h"

namespace LAMMPS_NS {

ComputeDCHWork::ComputeDCHWork(LAMMPS* lammps, int narg, char** arg)
    : Compute(lammps, narg, arg), fix_id_(std::string(id) + "_DCH_WORK") {
  if (narg != 3)
    error->all(FLERR, std::string("Compute dch/work takes no arguments: 'compute ") + id + " all dch/work'");
  if (igroup != 0)
    error->all(FLERR,
               std::string("Compute dch/work: the group has to be all, since every atom needs a weight"));
  peratom_flag = 1;
  size_peratom_cols = 0;
  NeighborDCH::install(lammps);
  FixDCHWork::install(lammps, fix_id_, *this);
  invoked_peratom = update->ntimestep;
}

ComputeDCHWork::~ComputeDCHWork() {
  if (modify->find_fix(fix_id_) >= 0) modify->delete_fix(fix_id_);
}

/// Where the numbers are is known.
void ComputeDCHWork::compute_peratom() { invoked_peratom = update->ntimestep; }

}  // namespace LAMMPS_NS
