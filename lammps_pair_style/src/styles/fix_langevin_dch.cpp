// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_langevin_dch.h"

#include <array>
#include <atom.h>
#include <comm.h>
#include <compute.h>
#include <cstring>
#include <error.h>
#include <group.h>
#include <modify.h>
#include <update.h>
#include <utils.h>

#include "atom_vectors.h"
#include "group_runs.h"
#include "stock_name.h"

namespace LAMMPS_NS {

FixLangevinDCH::FixLangevinDCH(LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      name_(std::string("Fix langevin/dch ") + arg[0] + ": "),
      plain_(modify->fix_map->at(dch::lammps::stock_name(*modify->fix_map, "langevin"))(lammps, narg, arg)),
      bath_(lammps),
      noise_(utils::inumeric(FLERR, arg[6], false, lammps) + comm->me) {
  dynamic_group_allow = plain_->dynamic_group_allow;
  scalar_flag = plain_->scalar_flag;
  global_freq = plain_->global_freq;
  extscalar = plain_->extscalar;
  ecouple_flag = plain_->ecouple_flag;
  nevery = plain_->nevery;
  maxexchange = plain_->maxexchange;
  if (std::strncmp(arg[3], "v_", 2) == 0)
    bath_.variable = arg[3] + 2;
  else
    bath_.start = target_ = utils::numeric(FLERR, arg[3], false, lammps);
  bath_.stop = utils::numeric(FLERR, arg[4], false, lammps);
  bath_.damping = utils::numeric(FLERR, arg[5], false, lammps);
  read_keywords(narg, arg);
}

/// Which the plain style has checked.
void FixLangevinDCH::read_keywords(int narg, char** arg) {
  for (int at = 7; at < narg; at += 2) {
    const std::string keyword = arg[at], value = arg[at + 1];
    if (keyword == "scale" && !utils::is_integer(arg[at + 1])) {
      by_plain_ = "types by name";
      ++at;
    } else if (keyword == "scale") {
      bath_.ratio[static_cast<std::size_t>(utils::inumeric(FLERR, arg[at + 1], false, lmp))] =
          utils::numeric(FLERR, arg[at + 2], false, lmp);
      ++at;
    } else if (keyword == "zero") {
      is_zeroed_ = value != "no";
    } else if (value != "no") {
      by_plain_ = std::string(arg[at]) + " " + value;
    }
  }
}

int FixLangevinDCH::setmask() { return plain_->setmask(); }

void FixLangevinDCH::init() {
  take_bias();
  plain_->init();
  constexpr int kRun = 1;
  const bool by_levels = update->whichflag == kRun && std::strncmp(update->integrate_style, "respa", 5) == 0;
  if (by_plain_.empty() && by_levels) {
    by_plain_ = "r-RESPA, in this run or one before";
    if (has_drawn_ && comm->me == 0)
      error->warning(
          FLERR, name_ + "random numbers begin again with 'run_style respa', which plain fix langevin does");
  }
  bath_.take_prefactors();
}

/// The plain style has looked for the compute, and keeps it.
void FixLangevinDCH::take_bias() {
  bias_ = nullptr;
  if (bias_name_.empty()) return;
  const int at = modify->find_compute(bias_name_);
  if (at < 0)
    error->all(FLERR, name_ + "there is no compute '" + bias_name_ + "' any more; give 'fix_modify' again");
  if (modify->compute[at]->tempbias) bias_ = modify->compute[at];
}

void FixLangevinDCH::setup(int vflag) {
  if (by_plain_.empty())
    post_force(vflag);
  else
    plain_->setup(vflag);
}

void FixLangevinDCH::reset_dt() {
  plain_->reset_dt();
  bath_.take_prefactors();
}

void FixLangevinDCH::reset_target(double temperature) {
  plain_->reset_target(temperature);
  bath_.start = bath_.stop = target_ = temperature;
}

int FixLangevinDCH::modify_param(int narg, char** arg) {
  const int taken = plain_->modify_param(narg, arg);
  if (std::strcmp(arg[0], "temp") != 0) return taken;
  bias_name_ = arg[1];
  // As the plain style does, at once if there is one already, and else at the next setup.
  if (bias_) bias_ = modify->compute[modify->find_compute(bias_name_)];
  return taken;
}

void* FixLangevinDCH::extract(const char* name, int& dimension) {
  void* const found = plain_->extract(name, dimension);
  return by_plain_.empty() && std::strcmp(name, "t_target") == 0 ? &target_ : found;
}

void FixLangevinDCH::post_force(int vflag) {
  if (!by_plain_.empty()) {
    plain_->post_force(vflag);
    return;
  }
  bath_.take_temperature(igroup, name_);
  target_ = bath_.temperature();
  has_drawn_ = true;
  if (bias_) bias_->compute_scalar();
  sum_ = {};
  for_batches_of_group(atom->mask, groupbit, atom->nlocal,
                       [this](const int* atoms, int count) { add_forces(atoms, count); });
  if (is_zeroed_) subtract_mean();
}

void FixLangevinDCH::add_forces(const int* atoms, int count) {
  std::array<dch::Vec3, kMostInRun> noises;
  const dch::Span<dch::Vec3> noise(noises.data(), static_cast<std::size_t>(count));
  noise_.draw(noise);
  if (bias_) {
    for (int k = 0; k < count; ++k) add_force_without_bias(atoms[k], noises[static_cast<std::size_t>(k)]);
    return;
  }
  bath_.add_forces(atoms, noise);
  for (int k = 0; is_zeroed_ && k < count; ++k)
    sum_ = sum_ + bath_.strength(atoms[k]) * noise[static_cast<std::size_t>(k)];
}

/// By velocities without what the compute takes as flow. Where nothing is left of one there is no noise: some
/// computes say so that an atom does not take part.
void FixLangevinDCH::add_force_without_bias(int i, dch::Vec3 noise) {
  double* const v = atom->v[i];
  bias_->remove_bias(i, v);
  const double drag = bath_.drag(i), strength = bath_.strength(i);
  for (int axis = 0; axis < 3; ++axis) {
    const double of_noise = v[axis] == 0 ? 0 : strength * noise[axis];
    atom->f[i][axis] += drag * v[axis] + of_noise;
    (axis == 0 ? sum_.x : axis == 1 ? sum_.y : sum_.z) += of_noise;
  }
  bias_->restore_bias(i, v);
}

void FixLangevinDCH::subtract_mean() {
  const auto count = static_cast<double>(group->count(igroup));
  if (count == 0) error->all(FLERR, name_ + "'zero yes' needs atoms, but its group has none");
  dch::Vec3 mean;
  MPI_Allreduce(&sum_, &mean, 3, MPI_DOUBLE, MPI_SUM, world);
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int axis = 0; axis < 3; ++axis) atom->f[i][axis] -= mean[axis] / count;
}

dch::lammps::StyleNote FixLangevinDCH::explain() const {
  if (by_plain_.empty()) return {"langevin/dch", "SIMD kernel, the random numbers of fix langevin"};
  return {"langevin/dch", "plain style, as kernels do not know " + by_plain_};
}

// What the plain style alone does.

void FixLangevinDCH::initial_integrate(int vflag) { plain_->initial_integrate(vflag); }
void FixLangevinDCH::post_force_respa(int vflag, int level, int loop) {
  plain_->post_force_respa(vflag, level, loop);
}
void FixLangevinDCH::end_of_step() { plain_->end_of_step(); }
double FixLangevinDCH::compute_scalar() { return plain_->compute_scalar(); }
double FixLangevinDCH::memory_usage() { return plain_->memory_usage(); }
void FixLangevinDCH::grow_arrays(int most) { plain_->grow_arrays(most); }
void FixLangevinDCH::copy_arrays(int from, int to, int is_deleted) {
  plain_->copy_arrays(from, to, is_deleted);
}
int FixLangevinDCH::pack_exchange(int i, double* to) { return plain_->pack_exchange(i, to); }
int FixLangevinDCH::unpack_exchange(int i, double* from) { return plain_->unpack_exchange(i, from); }

}  // namespace LAMMPS_NS
