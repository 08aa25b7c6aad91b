// SPDX-License-Identifier: GPL-2.0-or-later
#include "langevin_bath.h"

#include <cmath>
#include <error.h>
#include <force.h>
#include <group.h>
#include <input.h>
#include <modify.h>
#include <update.h>
#include <variable.h>

#include <dch/forces/langevin.hpp>

#include "atom_vectors.h"
#include "group_runs.h"

namespace LAMMPS_NS {
namespace {

/// Adds the forces on atoms that do not all stand behind each other in memory.
void add_scattered(const int* atoms, dch::Span<const double> drag, dch::Span<const double> strength,
                   dch::Span<const dch::Vec3> noise, double** v, double** f) {
  std::array<dch::Vec3, kMostInRun> velocities, forces;
  const std::size_t count = noise.size();
  for (std::size_t k = 0; k < count; ++k) {
    velocities[k] = vectors(v, atoms[k], 1)[0];
    forces[k] = vectors(f, atoms[k], 1)[0];
  }
  dch::add_langevin_forces(drag, strength, {velocities.data(), count}, noise, {forces.data(), count});
  for (std::size_t k = 0; k < count; ++k) vectors(f, atoms[k], 1)[0] = forces[k];
}

}  // namespace

LangevinBath::LangevinBath(LAMMPS* lammps)
    : Pointers(lammps), ratio(static_cast<std::size_t>(lammps->atom->ntypes) + 1, 1.0) {}

bool LangevinBath::is_of_all_atoms() const {
  if (variable.empty()) return true;
  const int number = input->variable->find(variable.c_str());
  return number >= 0 && input->variable->equalstyle(number);
}

void LangevinBath::take_prefactors() {
  drag_ = strength_ = std::vector<double>(ratio.size());
  if (atom->rmass) return;
  for (int type = 1; type <= atom->ntypes; ++type) {
    const auto at = static_cast<std::size_t>(type);
    drag_[at] = -atom->mass[type] / damping / force->ftm2v * (1.0 / ratio[at]);
    strength_[at] = std::sqrt(atom->mass[type]) *
                    std::sqrt(24.0 * force->boltz / damping / update->dt / force->mvv2e) / force->ftm2v *
                    (1.0 / std::sqrt(ratio[at]));
  }
}

void LangevinBath::take_temperature(int group_number, const std::string& name_in_messages) {
  is_of_atoms_ = false;
  if (variable.empty()) {
    auto share = static_cast<double>(update->ntimestep - update->beginstep);
    if (share != 0) share /= static_cast<double>(update->endstep - update->beginstep);
    temperature_ = start + share * (stop - start);
    root_ = std::sqrt(temperature_);
    return;
  }
  const int number = input->variable->find(variable.c_str());
  is_of_atoms_ = !input->variable->equalstyle(number);
  modify->clearstep_compute();
  if (is_of_atoms_) {
    temperatures_.resize(static_cast<std::size_t>(atom->nmax));
    input->variable->compute_atom(number, group_number, temperatures_.data(), 1, 0);
  } else {
    temperature_ = input->variable->compute_equal(number);
  }
  const int bit = group->bitmask[group_number];
  const auto check = [&](double found) {
    if (!(found >= 0))
      error->one(FLERR, name_in_messages + "variable '" + variable + "' is " + std::to_string(found) +
                            " but has to be a temperature of 0 or more");
  };
  if (!is_of_atoms_) check(temperature_);
  for (int i = 0; is_of_atoms_ && i < atom->nlocal; ++i)
    if (atom->mask[i] & bit) check(temperatures_[static_cast<std::size_t>(i)]);
  root_ = std::sqrt(temperature_);
  modify->addstep_compute(update->ntimestep + 1);
}

double LangevinBath::drag(int i) const {
  const auto type = static_cast<std::size_t>(atom->type[i]);
  if (!atom->rmass) return drag_[type];
  return -atom->rmass[i] / damping / force->ftm2v * (1.0 / ratio[type]);
}

double LangevinBath::strength(int i) const {
  const auto type = static_cast<std::size_t>(atom->type[i]);
  const double root = is_of_atoms_ ? std::sqrt(temperatures_[static_cast<std::size_t>(i)]) : root_;
  if (!atom->rmass) return strength_[type] * root;
  return std::sqrt(atom->rmass[i]) * std::sqrt(24.0 * force->boltz / damping / update->dt / force->mvv2e) /
         force->ftm2v * (1.0 / std::sqrt(ratio[type]) * root);
}

void LangevinBath::add_forces(const int* atoms, dch::Span<const dch::Vec3> noise) const {
  std::array<double, kMostInRun> drags, strengths;
  const std::size_t count = noise.size();
  for (std::size_t k = 0; k < count; ++k) {
    drags[k] = drag(atoms[k]);
    strengths[k] = strength(atoms[k]);
  }
  const dch::Span<const double> of_drag(drags.data(), count), of_noise(strengths.data(), count);
  const auto all = static_cast<int>(count);
  if (atoms[all - 1] - atoms[0] == all - 1)
    dch::add_langevin_forces(of_drag, of_noise, vectors(atom->v, atoms[0], all), noise,
                             vectors(atom->f, atoms[0], all));
  else
    add_scattered(atoms, of_drag, of_noise, noise, atom->v, atom->f);
}

}  // namespace LAMMPS_NS
