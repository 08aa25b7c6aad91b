// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_langevin_philox.h"

#include <array>
#include <atom.h>
#include <cmath>
#include <cstring>
#include <error.h>
#include <group.h>
#include <update.h>

#include <dch/forces/langevin.hpp>

#include "finite_number.h"
#include "group_runs.h"
#include "id_numbers.h"

namespace LAMMPS_NS {

FixLangevinPhilox::FixLangevinPhilox(LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), name_(std::string("Fix langevin/philox ") + arg[0] + ": "), bath_(lammps) {
  if (narg < 7)
    error->all(FLERR, name_ +
                          "two temperatures, the damping time and the seed are wanted; for example "
                          "'fix bath all langevin/philox 1.0 1.0 10.0 904297'");
  dynamic_group_allow = 1;
  if (std::strncmp(arg[3], "v_", 2) == 0)
    bath_.variable = arg[3] + 2;
  else
    bath_.start = target_ = finite_number(arg[3]);
  bath_.stop = finite_number(arg[4]);
  bath_.damping = finite_number(arg[5]);
  const double seed = finite_number(arg[6]);
  if (!(bath_.start >= 0 && bath_.stop >= 0))
    error->all(FLERR, name_ + "the temperatures are '" + arg[3] + "' and '" + arg[4] +
                          "' but have to be numbers of 0 or more, the first one or v_NAME");
  if (!(bath_.damping > 0))
    error->all(FLERR, name_ + "the damping time is '" + arg[5] + "' but has to be a number > 0");
  if (!(seed >= 1 && seed <= MAXSMALLINT && seed == std::floor(seed)))
    error->all(FLERR,
               name_ + "the seed is '" + arg[6] + "' but has to be a whole number from 1 to 2147483647");
  seed_ = static_cast<std::uint32_t>(seed);
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
  bath_.ratio[static_cast<std::size_t>(number)] = value;
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
  if (!bath_.is_of_all_atoms())
    error->all(FLERR, name_ + "there is no variable '" + bath_.variable +
                          "' of style equal; for temperatures by atom use fix langevin");
  bath_.take_prefactors();
}

void FixLangevinPhilox::reset_dt() { bath_.take_prefactors(); }

void FixLangevinPhilox::reset_target(double temperature) { bath_.start = bath_.stop = target_ = temperature; }

void* FixLangevinPhilox::extract(const char* name, int& dimension) {
  dimension = 0;
  return std::strcmp(name, "t_target") == 0 ? &target_ : nullptr;
}

void FixLangevinPhilox::setup(int vflag) { post_force(vflag); }

void FixLangevinPhilox::post_force(int) {
  bath_.take_temperature(igroup, name_);
  target_ = bath_.temperature();
  if (is_zeroed_) sums_.assign(bath_.ratio.size(), {});
  for_batches_of_group(atom->mask, groupbit, atom->nlocal,
                       [&](const int* atoms, int count) { add_forces(atoms, count); });
  if (is_zeroed_) subtract_mean();
}

void FixLangevinPhilox::add_forces(const int* atoms, int count) {
  std::array<std::int32_t, kMostInRun> ids;
  std::array<dch::Vec3, kMostInRun> noises;
  const auto size = static_cast<std::size_t>(count);
  for (std::size_t k = 0; k < size; ++k) ids[k] = drawn_by(atom->tag[atoms[k]], *error);
  const dch::Span<dch::Vec3> noise(noises.data(), size);
  dch::uniform_noise(seed_, update->ntimestep, {ids.data(), size}, noise);
  bath_.add_forces(atoms, noise);
  if (!is_zeroed_) return;
  for (std::size_t k = 0; k < size; ++k) {
    dch::Vec3& sum = sums_[static_cast<std::size_t>(atom->type[atoms[k]])];
    sum = sum + noise[k];
  }
}

/// Noise is a multiple of 2^-33, so sums of it below 2^20 have no rounding error: whatever the order of atoms
/// and the number of processes, they are the same.
void FixLangevinPhilox::subtract_mean() {
  const auto count = static_cast<double>(group->count(igroup));
  if (count == 0) error->all(FLERR, name_ + "'zero yes' needs atoms, but its group has none");
  std::vector<dch::Vec3> of_all(sums_.size());
  MPI_Allreduce(sums_.data(), of_all.data(), static_cast<int>(3 * sums_.size()), MPI_DOUBLE, MPI_SUM, world);
  dch::Vec3 mean;
  for (int type = 1; type <= atom->ntypes; ++type)
    mean = mean + bath_.strength_of_type(type) / count * of_all[static_cast<std::size_t>(type)];
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int axis = 0; axis < 3; ++axis) atom->f[i][axis] -= mean[axis];
}

}  // namespace LAMMPS_NS
