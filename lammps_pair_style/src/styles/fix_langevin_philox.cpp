// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_langevin_philox.h"

#include <array>
#include <atom.h>
#include <cmath>
#include <cstring>
#include <error.h>
#include <force.h>
#include <group.h>
#include <input.h>
#include <modify.h>
#include <update.h>
#include <variable.h>

#include <dch/forces/langevin.hpp>

#include "atom_vectors.h"
#include "finite_number.h"
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

FixLangevinPhilox::FixLangevinPhilox(LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), name_(std::string("Fix langevin/philox ") + arg[0] + ": ") {
  if (narg < 7)
    error->all(FLERR, name_ +
                          "two temperatures, the damping time and the seed are wanted; for example "
                          "'fix bath all langevin/philox 1.0 1.0 10.0 904297'");
  dynamic_group_allow = 1;
  if (std::strncmp(arg[3], "v_", 2) == 0)
    variable_ = arg[3] + 2;
  else
    start_ = finite_number(arg[3]);
  stop_ = finite_number(arg[4]);
  damping_ = finite_number(arg[5]);
  const double seed = finite_number(arg[6]);
  if (!(start_ >= 0 && stop_ >= 0))
    error->all(FLERR, name_ + "the temperatures are '" + arg[3] + "' and '" + arg[4] +
                          "' but have to be numbers of 0 or more, the first one or v_NAME");
  if (!(damping_ > 0))
    error->all(FLERR, name_ + "the damping time is '" + arg[5] + "' but has to be a number > 0");
  if (!(seed >= 1 && seed <= MAXSMALLINT && seed == std::floor(seed)))
    error->all(FLERR,
               name_ + "the seed is '" + arg[6] + "' but has to be a whole number from 1 to 2147483647");
  seed_ = static_cast<std::uint32_t>(seed);
  ratio_.assign(static_cast<std::size_t>(atom->ntypes) + 1, 1.0);
  read_keywords(narg, arg);
  if (!atom->tag_enable)
    error->all(FLERR, name_ + "atoms have no IDs, on which random numbers depend; use fix langevin");
}

void FixLangevinPhilox::read_keywords(int narg, char** arg) {
  for (int at = 7; at < narg;) {
    const std::string keyword = arg[at];
    const int values = keyword == "scale" ? 2 : 1;
    if (at + values >= narg)
      error->all(FLERR, name_ + "'" + keyword + "' is followed by " + std::to_string(narg - at - 1) + " of " +
                            std::to_string(values) + " values");
    const std::string value = arg[at + 1];
    if (keyword == "scale") {
      read_scale(arg[at + 1], arg[at + 2]);
    } else if (keyword == "zero") {
      if (value != "yes" && value != "no")
        error->all(FLERR, name_ + "zero is '" + value + "' but has to be yes or no");
      is_zeroed_ = value == "yes";
    } else if (keyword == "angmom" || keyword == "gjf" || keyword == "omega" || keyword == "tally") {
      if (value != "no")
        error->all(FLERR, name_ + "it has no '" + std::string(arg[at]).append(" ").append(value) +
                              "'; use fix langevin");
    } else {
      error->all(FLERR, name_ + "unknown keyword '" + keyword + "'; there are scale and zero");
    }
    at += 1 + values;
  }
}

void FixLangevinPhilox::read_scale(const char* type, const char* ratio) {
  const double number = finite_number(type), value = finite_number(ratio);
  if (!(number >= 1 && number <= atom->ntypes && number == std::floor(number) && value > 0))
    error->all(FLERR, name_ + "scale is followed by '" + type + "' and '" + ratio +
                          "' but wants a type from 1 to " + std::to_string(atom->ntypes) +
                          " and a number > 0");
  ratio_[static_cast<std::size_t>(number)] = value;
}

int FixLangevinPhilox::modify_param(int, char** arg) {
  if (std::strcmp(arg[0], "temp") == 0)
    error->all(FLERR, name_ + "it takes no bias from velocities, so no 'fix_modify temp'; use fix langevin");
  return 0;
}

int FixLangevinPhilox::setmask() { return FixConst::POST_FORCE; }

void FixLangevinPhilox::init() {
  if (std::strncmp(update->integrate_style, "respa", 5) == 0)
    error->all(FLERR, name_ + "it does not know 'run_style respa'; use fix langevin");
  if (atom->rmass) error->all(FLERR, name_ + "it does not know masses by atom; use fix langevin");
  if (!variable_.empty()) {
    const int number = input->variable->find(variable_.c_str());
    if (number < 0 || !input->variable->equalstyle(number))
      error->all(FLERR, name_ + "there is no variable '" + variable_ +
                            "' of style equal; for temperatures by atom use fix langevin");
  }
  take_prefactors();
}

/// The numbers of fix langevin, by its operations.
void FixLangevinPhilox::take_prefactors() {
  drag_ = strength_ = std::vector<double>(ratio_.size());
  for (int type = 1; type <= atom->ntypes; ++type) {
    const auto at = static_cast<std::size_t>(type);
    drag_[at] = -atom->mass[type] / damping_ / force->ftm2v * (1.0 / ratio_[at]);
    strength_[at] = std::sqrt(atom->mass[type]) *
                    std::sqrt(24.0 * force->boltz / damping_ / update->dt / force->mvv2e) / force->ftm2v *
                    (1.0 / std::sqrt(ratio_[at]));
  }
}

void FixLangevinPhilox::reset_dt() { take_prefactors(); }

void FixLangevinPhilox::setup(int vflag) { post_force(vflag); }

/// Of the bath at this step.
double FixLangevinPhilox::temperature() {
  if (variable_.empty()) {
    auto share = static_cast<double>(update->ntimestep - update->beginstep);
    if (share != 0) share /= static_cast<double>(update->endstep - update->beginstep);
    return start_ + share * (stop_ - start_);
  }
  modify->clearstep_compute();
  const double found = input->variable->compute_equal(input->variable->find(variable_.c_str()));
  if (!(found >= 0))
    error->one(FLERR, name_ + "variable '" + variable_ + "' is " + std::to_string(found) +
                          " but has to be a temperature of 0 or more");
  modify->addstep_compute(update->ntimestep + 1);
  return found;
}

void FixLangevinPhilox::post_force(int) {
  const double root = std::sqrt(temperature());
  if (is_zeroed_) sums_.assign(ratio_.size(), {});
  for_batches_of_group(atom->mask, groupbit, atom->nlocal,
                       [&](const int* atoms, int count) { add_forces(atoms, count, root); });
  if (is_zeroed_) subtract_mean(root);
}

void FixLangevinPhilox::add_forces(const int* atoms, int count, double root_of_temperature) {
  std::array<std::int32_t, kMostInRun> ids;
  std::array<double, kMostInRun> drags, strengths;
  std::array<dch::Vec3, kMostInRun> noises;
  const auto size = static_cast<std::size_t>(count);
  for (std::size_t k = 0; k < size; ++k) {
    const auto type = static_cast<std::size_t>(atom->type[atoms[k]]);
    ids[k] = atom->tag[atoms[k]];
    drags[k] = drag_[type];
    strengths[k] = strength_[type] * root_of_temperature;
  }
  const dch::Span<const double> drag(drags.data(), size), strength(strengths.data(), size);
  const dch::Span<dch::Vec3> noise(noises.data(), size);
  dch::uniform_noise(seed_, update->ntimestep, {ids.data(), size}, noise);
  if (atoms[count - 1] - atoms[0] == count - 1)
    dch::add_langevin_forces(drag, strength, vectors(atom->v, atoms[0], count), noise,
                             vectors(atom->f, atoms[0], count));
  else
    add_scattered(atoms, drag, strength, noise, atom->v, atom->f);
  if (!is_zeroed_) return;
  for (std::size_t k = 0; k < size; ++k) {
    dch::Vec3& sum = sums_[static_cast<std::size_t>(atom->type[atoms[k]])];
    sum = sum + noise[k];
  }
}

/// Noise is a multiple of 2^-33, so sums of it below 2^20 have no rounding error: whatever the order of atoms
/// and the number of processes, they are the same.
void FixLangevinPhilox::subtract_mean(double root_of_temperature) {
  const auto count = static_cast<double>(group->count(igroup));
  if (count == 0) error->all(FLERR, name_ + "'zero yes' needs atoms, but its group has none");
  std::vector<dch::Vec3> of_all(sums_.size());
  MPI_Allreduce(sums_.data(), of_all.data(), static_cast<int>(3 * sums_.size()), MPI_DOUBLE, MPI_SUM, world);
  dch::Vec3 mean;
  for (std::size_t type = 1; type < of_all.size(); ++type)
    mean = mean + strength_[type] * root_of_temperature / count * of_all[type];
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int axis = 0; axis < 3; ++axis) atom->f[i][axis] -= mean[axis];
}

}  // namespace LAMMPS_NS
