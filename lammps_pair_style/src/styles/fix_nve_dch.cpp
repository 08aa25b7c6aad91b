// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_dch.h"

#include <array>
#include <atom.h>
#include <force.h>
#include <modify.h>
#include <update.h>

#include <dch/forces/motion.hpp>

#include "atom_vectors.h"
#include "group_runs.h"
#include "stock_name.h"

namespace LAMMPS_NS {

FixNVEDCH::FixNVEDCH(LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      plain_(modify->fix_map->at(dch::lammps::stock_name(*modify->fix_map, "nve"))(lammps, narg, arg)) {
  dynamic_group_allow = plain_->dynamic_group_allow;
  time_integrate = plain_->time_integrate;
}

int FixNVEDCH::setmask() { return plain_->setmask(); }

void FixNVEDCH::init() {
  plain_->init();
  turns_ = {};
  take_step();
}

void FixNVEDCH::reset_dt() {
  plain_->reset_dt();
  take_step();
}

/// Here and nowhere else, as the plain style does: 'run pre no' goes on with the step of the run before.
void FixNVEDCH::take_step() {
  step_ = update->dt;
  half_step_ = 0.5 * update->dt * force->ftm2v;
}

template <class Act>
void FixNVEDCH::for_atoms(Act act) {
  if (!atom->rmass) {
    half_step_over_mass_.assign(static_cast<std::size_t>(atom->ntypes) + 1, 0.0);
    for (int type = 1; type <= atom->ntypes; ++type)
      half_step_over_mass_[static_cast<std::size_t>(type)] = half_step_ / atom->mass[type];
  }
  const int end = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  std::array<double, kMostInRun> over_mass;
  for_runs_of_group(atom->mask, groupbit, 0, end, [&](int first, int count) {
    for (int k = 0; k < count; ++k)
      over_mass[static_cast<std::size_t>(k)] =
          atom->rmass ? half_step_ / atom->rmass[first + k]
                      : half_step_over_mass_[static_cast<std::size_t>(atom->type[first + k])];
    act(first, count, dch::Span<const double>(over_mass.data(), static_cast<std::size_t>(count)));
  });
}

dch::lammps::StyleNote FixNVEDCH::explain() const { return {"nve/dch", describe(turns_, "r-RESPA")}; }

void FixNVEDCH::initial_integrate(int) {
  ++turns_.by_kernel;
  for_atoms([this](int first, int count, dch::Span<const double> over_mass) {
    dch::kick_and_drift(over_mass, step_, vectors(atom->f, first, count), vectors(atom->v, first, count),
                        vectors(atom->x, first, count));
  });
}

void FixNVEDCH::final_integrate() {
  for_atoms([this](int first, int count, dch::Span<const double> over_mass) {
    dch::kick(over_mass, vectors(atom->f, first, count), vectors(atom->v, first, count));
  });
}

void FixNVEDCH::initial_integrate_respa(int vflag, int level, int loop) {
  ++turns_.by_plain;
  plain_->initial_integrate_respa(vflag, level, loop);
}

void FixNVEDCH::final_integrate_respa(int level, int loop) { plain_->final_integrate_respa(level, loop); }

}  // namespace LAMMPS_NS
