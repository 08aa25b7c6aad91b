// SPDX-License-Identifier: GPL-2.0-or-later
// The forces of the pair styles of this package: over clusters, pair by pair, or by the plain style.
#include <algorithm>
#include <atom.h>
#include <cmath>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <kspace.h>
#include <neighbor.h>
#include <utility>

#include "neighbor_dch.h"
#include "pair_dch.h"
#include "restart_numbers.h"

namespace LAMMPS_NS {

void PairDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (!clusters_ || clusters_->by_levels) {
    compute_plain(eflag, vflag);
    return;
  }
  ++computed_;
  const bool asks_each_pair = evflag && (cvflag_atom || num_tally_compute > 0);
  stop_if_it_fails([&] {
    if (!kernel_) kernel_ = std::make_unique<dch::PairPotential>(kernel_params());
    refresh();
    if (asks_each_pair) {
      ++pair_by_pair_;
      compute_pair_by_pair();
    } else {
      compute_clusters();
    }
    check_forces();
    if (eflag_either) add_self_energies(asks_each_pair || eflag_atom);
  });
}

/// Only where it has the lists with these levels that it has asked for.
Pair& PairDCH::plain_of_levels() const {
  if (!has_lists_of_plain_)
    error->all(FLERR, title() +
                          " does not know how this LAMMPS asks for lists with levels of r-RESPA; give "
                          "'suffix off' before the pair_style, or all pair forces one level");
  return *plain_;
}

void PairDCH::compute_inner() { plain_of_levels().compute_inner(); }
void PairDCH::compute_middle() { plain_of_levels().compute_middle(); }

void PairDCH::compute_outer(int eflag, int vflag) {
  ev_init(eflag, vflag);
  plain_of_levels().compute_outer(eflag, vflag);
  take_sums_of_plain();
}

dch::Span<const dch::Vec3> PairDCH::positions() const {
  const std::size_t points = clusters_->atoms();
  return {points > 0 ? reinterpret_cast<const dch::Vec3*>(atom->x[0]) : nullptr, points};
}

dch::Span<const double> PairDCH::charges() const {
  if (!has_charges()) return {};
  return {atom->q, clusters_->atoms()};
}

dch::Box PairDCH::box() const { return clusters_->in_box ? box_of(*domain) : dch::Box::none(); }

std::array<double, 4> PairDCH::weights(const double* special) const {
  return {1, special[1], special[2], special[3]};
}

void PairDCH::refresh() {
  clusters_->take_types(atom->type, atom->ntypes);
  if (!clusters_->one_by_one)
    clusters_->pairs.refresh(positions(), box(), NeighborDCH::install(lmp)->executor());
}

void PairDCH::take_numbers(const PairsOfTypes& given, dch::PairPotentialParams& params) const {
  const RestartNumbers of_plain(*plain_, plain_name_, atom->ntypes, style_.numbers, given, *error);
  take_all(of_plain.all(), params);
  const auto n = static_cast<std::size_t>(atom->ntypes);
  for (std::size_t k = 0; k < given.size(); ++k) {
    const auto a = static_cast<std::size_t>(given[k].first - 1),
               b = static_cast<std::size_t>(given[k].second - 1);
    dch::FormPair& pair = params.pairs[a * n + b];
    take_pair(of_plain.all(), of_plain.of_pair(k), pair);
    // Versions shift the energy of lj/expand by what it is at different distances, some by not all of it.
    double slope = 0;
    if (params.shifted && style_.form == dch::PairForm::expanded)
      pair.left_at_cutoff =
          plain_->single(0, 0, given[k].first, given[k].second, pair.cutoff * pair.cutoff, 1, 1, slope);
    params.pairs[b * n + a] = params.pairs[a * n + b];
  }
}

void PairDCH::take_pair(const double*, const double*, dch::FormPair&) const {}

dch::PairPotentialParams PairDCH::kernel_params() const {
  PairsOfTypes given;
  for (const PairOfTypes& p : pairs_of_types_) given.emplace_back(p.a, p.b);
  const auto n = static_cast<std::size_t>(atom->ntypes);
  dch::PairPotentialParams params;
  params.form = style_.form;
  params.charges = style_.charges;
  params.types = atom->ntypes;
  params.pairs.resize(n * n);
  params.constant = force->qqrd2e;
  params.shifted = offset_flag != 0;
  if (style_.charges == dch::ChargeForm::ewald) params.splitting = force->kspace->g_ewald;
  take_numbers(given, params);
  return params;
}

/// With newton off for pairs each process computes its own half of a pair with a ghost. Kernels add to both;
/// LAMMPS would send the other half home where newton is on for bonds.
void PairDCH::compute_clusters() {
  const ClusterList& wanted = *clusters_;
  const std::size_t points = wanted.atoms();
  const dch::Span<dch::Vec3> f{points > 0 ? reinterpret_cast<dch::Vec3*>(atom->f[0]) : nullptr, points};
  const bool keeps_ghosts = force->newton && !force->newton_pair && !wanted.in_box;
  if (keeps_ghosts) of_ghosts_.assign(f.begin() + atom->nlocal, f.end());
  const dch::ForcePrecision precision = NeighborDCH::install(lmp)->precision();
  kernel_->set_executor(NeighborDCH::install(lmp)->executor());
  const bool with_sums = eflag_either || vflag_either;
  // With newton off each of two processes has half of a pair with a ghost, which sums over pairs do not know.
  const bool has_halves = with_sums && !wanted.in_box && !force->newton_pair;
  tallies_.assign(has_halves || eflag_atom || vflag_atom ? points : 0, {});
  dch::LennardJonesSums sums;
  if (wanted.one_by_one) {
    if (!tallies_.empty()) {
      sums = kernel_->add_forces_and_tally(wanted.pair_list, positions(), box(), f, tallies_, charges());
    } else if (with_sums) {
      sums = kernel_->add_forces_and_sum(wanted.pair_list, positions(), box(), f, charges());
    } else {
      kernel_->add_forces(wanted.pair_list, positions(), box(), f, charges());
    }
  } else if (!tallies_.empty()) {
    sums = kernel_->add_forces_and_tally(wanted.pairs, precision, f, tallies_, charges());
  } else if (with_sums) {
    sums = kernel_->add_forces_and_sum(wanted.pairs, precision, f, charges());
  } else {
    kernel_->add_forces(wanted.pairs, precision, f, charges());
  }
  const ClusterList::Special& special = wanted.special;
  kernel_->add_weighted({special.i, special.j, special.at, special.types, special.kind,
                         weights(force->special_lj), weights(force->special_coul)},
                        positions(), f, charges(), with_sums ? &sums : nullptr, tallies_);
  if (keeps_ghosts) std::copy(of_ghosts_.begin(), of_ghosts_.end(), f.begin() + atom->nlocal);
  give_tallies();
  if (has_halves) sums = sums_of_tallies();
  eng_vdwl += sums.energy;
  eng_coul += sums.coulomb_energy;
  for (int k = 0; k < 6; ++k) virial[k] += sums.virial[static_cast<std::size_t>(k)];
}

/// To the energies and virials by atom that LAMMPS asks for.
void PairDCH::give_tallies() {
  const std::size_t atoms = force->newton_pair ? tallies_.size() : static_cast<std::size_t>(atom->nlocal);
  for (std::size_t i = 0; i < std::min(atoms, tallies_.size()); ++i) {
    const dch::LennardJonesSums& of_atom = tallies_[i];
    if (eflag_atom) eatom[i] += of_atom.energy + of_atom.coulomb_energy;
    if (!vflag_atom) continue;
    for (std::size_t k = 0; k < 6; ++k) vatom[i][k] += of_atom.virial[k];
  }
}

/// Over owned atoms: of a pair with a ghost, the half that is this process's.
dch::LennardJonesSums PairDCH::sums_of_tallies() const {
  dch::LennardJonesSums sums;
  for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(atom->nlocal), tallies_.size()); ++i) {
    sums.energy += tallies_[i].energy;
    sums.coulomb_energy += tallies_[i].coulomb_energy;
    for (std::size_t k = 0; k < 6; ++k) sums.virial[k] += tallies_[i].virial[k];
  }
  return sums;
}

/// Of charges that know their own image.
void PairDCH::add_self_energies(bool by_atom) {
  const double of_charge = kernel_->self_energy();
  if (of_charge == 0) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double energy = of_charge * atom->q[i] * atom->q[i];
    if (by_atom)
      ev_tally(i, i, atom->nlocal, 0, 0, energy, 0, 0, 0, 0);
    else
      eng_coul += energy;
  }
}

/// Pairs on their way to be computed one by one and shown to who asks for each of them.
struct PairDCH::Batch {
  int count = 0;
  int i[dch::PairBatch::kSize], j[dch::PairBatch::kSize];
  dch::Vec3 from_j_to_i[dch::PairBatch::kSize];
  dch::PairBatch pairs;
};

void PairDCH::finish(Batch& batch) {
  kernel_->compute(batch.pairs, weights(force->special_lj), weights(force->special_coul));
  for (int k = 0; k < batch.count; ++k) {
    const int i = batch.i[k], j = batch.j[k];
    const double over_r = batch.pairs.force_over_r[k];
    const dch::Vec3 apart = batch.from_j_to_i[k], pull = over_r * apart;
    double **f = atom->f, *of_i = f[i], *of_j = f[j];
    of_i[0] += pull.x;
    of_i[1] += pull.y;
    of_i[2] += pull.z;
    if (force->newton_pair || j < atom->nlocal) {
      of_j[0] -= pull.x;
      of_j[1] -= pull.y;
      of_j[2] -= pull.z;
    }
    if (evflag)
      ev_tally(i, j, atom->nlocal, force->newton_pair, batch.pairs.energy[k], batch.pairs.coulomb_energy[k],
               over_r, apart.x, apart.y, apart.z);
  }
  batch = {};
}

bool PairDCH::forces_are_finite() const {
  bool all_are = true;
  const double* const forces = atom->nlocal > 0 ? atom->f[0] : nullptr;
  for (int k = 0; k < 3 * atom->nlocal; ++k) all_are &= std::abs(forces[k]) <= 1e300;
  return all_are;
}

void PairDCH::for_each_pair(const PairVisitor& visit) const {
  const auto take = [&](int i, int j, dch::Vec3 from_j_to_i, int kind) {
    if (norm2(from_j_to_i) < cutsq[atom->type[i]][atom->type[j]]) visit(i, j, from_j_to_i, kind);
  };
  const auto take_pair = [&](std::int32_t i, std::int32_t j, dch::Vec3 from_i_to_j) {
    if (i < atom->nlocal) {
      take(i, j, -1.0 * from_i_to_j, 0);
    } else {
      take(j, i, from_i_to_j, 0);
    }
  };
  if (clusters_->one_by_one) {
    clusters_->pair_list.for_each(positions(), box(), take_pair);
  } else {
    clusters_->pairs.for_each(take_pair);
  }
  const ClusterList::Special& special = clusters_->special;
  for (std::size_t k = 0; k < special.size(); ++k) {
    const double *xi = atom->x[special.i[k]], *xj = atom->x[special.at[k]];
    take(special.i[k], special.j[k], {xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]}, special.kind[k]);
  }
}

void PairDCH::compute_pair_by_pair() {
  Batch batch;
  for_each_pair([&](int i, int j, dch::Vec3 from_j_to_i, int kind) {
    const int k = batch.count++;
    batch.i[k] = i;
    batch.j[k] = j;
    batch.from_j_to_i[k] = from_j_to_i;
    batch.pairs.r2[k] = norm2(from_j_to_i);
    batch.pairs.types[k] = (atom->type[i] - 1) * atom->ntypes + atom->type[j] - 1;
    batch.pairs.kind[k] = kind;
    if (has_charges()) batch.pairs.charges[k] = atom->q[i] * atom->q[j];
    if (batch.count == dch::PairBatch::kSize) finish(batch);
  });
  finish(batch);
}

}  // namespace LAMMPS_NS
