// SPDX-License-Identifier: GPL-2.0-or-later
// The forces of dpd/philox and dpd/tstat/philox.
#include <algorithm>
#include <atom.h>
#include <cmath>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <neigh_list.h>
#include <new>
#include <update.h>

#include <dch/base/error.hpp>

#include "id_numbers.h"
#include "pair_dpd_philox.h"

namespace LAMMPS_NS {

/// Pairs on their way to be computed, with their atoms.
struct PairDPDPhilox::Batch {
  dch::DissipativeStep step;
  int i[dch::DissipativeBatch::kSize], j[dch::DissipativeBatch::kSize];
  dch::DissipativeBatch pairs;
};

/// Of the bath at this step.
double PairDPDPhilox::temperature() const {
  if (start_ == stop_) return start_;
  auto share = static_cast<double>(update->ntimestep - update->beginstep);
  if (share != 0) share /= static_cast<double>(update->endstep - update->beginstep);
  return start_ + share * (stop_ - start_);
}

void PairDPDPhilox::take_coefficients() {
  dch::DissipativeParams params;
  params.types = atom->ntypes;
  params.pairs = given_;
  params.seed = static_cast<std::uint32_t>(seed_);
  std::copy_n(force->special_lj, 4, params.weight.begin());
  forces_ = std::make_unique<dch::DissipativePairs>(params);
  check_box();
}

/// Two atoms have one random number, so they must not meet in two images.
void PairDPDPhilox::check_box() const {
  double widest = 0;
  for (const dch::DissipativePair& pair : given_) widest = std::max(widest, pair.cutoff);
  // Rows of the inverse of the cell's matrix, whose upper triangle LAMMPS keeps.
  const double* const h = domain->h_inv;
  const double height[3] = {1 / std::hypot(h[0], h[5], h[4]), 1 / std::hypot(h[1], h[3]), 1 / std::abs(h[2])};
  for (int axis = 0; axis < domain->dimension; ++axis)
    if (domain->periodicity[axis] && height[axis] < 2 * widest)
      error->all(FLERR, title() + "the box is " + std::to_string(height[axis]) + " wide along axis " +
                            std::to_string(axis + 1) + ", less than twice the cutoff of " +
                            std::to_string(widest) +
                            ", so two atoms meet in two images and would have one random number for both; "
                            "use a larger box");
}

void PairDPDPhilox::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  try {
    if (!forces_)
      take_coefficients();
    else if (domain->box_change)
      check_box();
    Batch batch;
    batch.step = {update->ntimestep, force->boltz * temperature(), update->dt};
    for (int row = 0; row < list->inum; ++row) add_row(list->ilist[row], batch);
    finish(batch);
  } catch (const dch::Error& e) {
    error->one(FLERR, title() + e.what());
  } catch (const std::bad_alloc&) {
    error->one(FLERR, title() + "out of memory; use more processes");
  }
  if (vflag_fdotr) virial_fdotr_compute();
}

/// Neighbors within the cutoff are found first, without a branch for each; about half of all are.
template <bool kOneType>
int PairDPDPhilox::find_near(int i) {
  const int* const row = list->firstneigh[i];
  const int count = list->numneigh[i];
  if (near_.size() < static_cast<std::size_t>(count)) near_.resize(static_cast<std::size_t>(count));
  int* const near = near_.data();
  const dch::Vec3* const x = reinterpret_cast<const dch::Vec3*>(atom->x[0]);
  const int* const type = atom->type;
  const double* const reach2 = cutsq[type[i]];
  const dch::Vec3 own = x[i];
  int found = 0;
  for (int k = 0; k < count; ++k) {
    const int j = row[k] & NEIGHMASK;
    near[found] = row[k];
    found += norm2(own - x[j]) < reach2[kOneType ? 1 : type[j]] ? 1 : 0;
  }
  return found;
}

void PairDPDPhilox::add_row(int i, Batch& batch) {
  const bool has_one_type = atom->ntypes == 1;
  const int found = has_one_type ? find_near<true>(i) : find_near<false>(i);
  const dch::Vec3* const x = reinterpret_cast<const dch::Vec3*>(atom->x[0]);
  const dch::Vec3* const v = reinterpret_cast<const dch::Vec3*>(atom->v[0]);
  const int* const type = atom->type;
  const tagint* const tag = atom->tag;
  const dch::Vec3 own = x[i], own_velocity = v[i];
  const int first_type = (type[i] - 1) * atom->ntypes - 1;
  const std::int32_t own_id = drawn_by(tag[i], *error);
  dch::DissipativeBatch& pairs = batch.pairs;
  for (int k = 0; k < found; ++k) {
    const int marked = near_[static_cast<std::size_t>(k)], j = marked & NEIGHMASK;
    const dch::Vec3 apart = own - x[j], velocity = own_velocity - v[j];
    const int at = pairs.count;
    batch.i[at] = i;
    batch.j[at] = j;
    pairs.x[at] = apart.x;
    pairs.y[at] = apart.y;
    pairs.z[at] = apart.z;
    pairs.vx[at] = velocity.x;
    pairs.vy[at] = velocity.y;
    pairs.vz[at] = velocity.z;
    pairs.first_id[at] = own_id;
    pairs.second_id[at] = drawn_by(tag[j], *error);
    pairs.types[at] = has_one_type ? 0 : first_type + type[j];
    pairs.kind[at] = sbmask(marked);
    if (++pairs.count == dch::DissipativeBatch::kSize) finish(batch);
  }
}

void PairDPDPhilox::finish(Batch& batch) {
  dch::DissipativeBatch& pairs = batch.pairs;
  if (pairs.count == 0) return;
  forces_->compute(batch.step, pairs);
  dch::Vec3* const f = reinterpret_cast<dch::Vec3*>(atom->f[0]);
  const int with_forces = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  for (int k = 0; k < pairs.count; ++k) {
    const int i = batch.i[k], j = batch.j[k];
    const double over_r = pairs.force_over_r[k];
    const dch::Vec3 pull = over_r * dch::Vec3{pairs.x[k], pairs.y[k], pairs.z[k]};
    f[i] = f[i] + pull;
    if (j < with_forces) f[j] = f[j] - pull;
    if (evflag)
      ev_tally(i, j, atom->nlocal, force->newton_pair, pairs.energy[k], 0, over_r, pairs.x[k], pairs.y[k],
               pairs.z[k]);
  }
  pairs.count = 0;
}

/// The repulsion alone, as that of dpd: random forces and drag have no energy.
double PairDPDPhilox::single(int, int, int itype, int jtype, double rsq, double, double factor_lj,
                             double& fforce) {
  const dch::DissipativePair& pair = of_types(itype, jtype);
  const double r = std::sqrt(rsq);
  fforce = 0;
  if (r < 1e-10 || r >= pair.cutoff) return 0;
  const double w = 1 - r / pair.cutoff;
  fforce = factor_lj * pair.repulsion * w / r;
  return factor_lj * 0.5 * pair.repulsion * pair.cutoff * w * w;
}

}  // namespace LAMMPS_NS
