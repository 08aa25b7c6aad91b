// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_lj_dch.h"

#include <atom.h>
#include <cmath>
#include <force.h>
#include <kspace.h>
#include <utility>

#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

/// Has atom number 0 carry this charge while it lives, whether there are atoms or not.
class ChargeOfAtom0 {
 public:
  ChargeOfAtom0(Atom& atom, double charge)
      : atom_(atom), charge_(charge), q_(std::exchange(atom.q, &charge_)) {}
  ~ChargeOfAtom0() { atom_.q = q_; }
  ChargeOfAtom0(const ChargeOfAtom0&) = delete;
  ChargeOfAtom0& operator=(const ChargeOfAtom0&) = delete;

 private:
  Atom& atom_;
  double charge_;
  double* q_;
};

}  // namespace

/// Where a part of the plain style's force ends. Styles with charges keep that to themselves; the force
/// tells.
double PairLJDCH::cutoff_of(Part part, const PairOfTypes& pair) const {
  if (charges_ == Charges::none) return part == Part::lennard_jones ? pair.cutoff : 0;
  const bool coulomb = part == Part::coulomb;
  const ChargeOfAtom0 charge(*atom, coulomb ? 1 : 0);
  const auto acts = [&](double r2) {
    double over_r = 0;
    plain().single(0, 0, pair.a, pair.b, r2, 1, coulomb ? 0 : 1, over_r);
    return over_r != 0;
  };
  double near = 0, far = pair.cutoff * pair.cutoff;
  if (acts(std::nextafter(far, 0.0))) return pair.cutoff;
  // As far as 2^-200 of the cutoff, where forces are 0 everywhere.
  for (int k = 0; k < 200 && near + 0.5 * (far - near) > near && near + 0.5 * (far - near) < far; ++k) {
    const double middle = near + 0.5 * (far - near);
    (acts(middle) ? near : far) = middle;
  }
  return near > 0 ? std::sqrt(far) : 0;
}

void PairLJDCH::make_kernel(const std::vector<PairOfTypes>& pairs) {
  int dimension = 0;
  auto* const epsilon = static_cast<double**>(plain().extract("epsilon", dimension));
  auto* const sigma = static_cast<double**>(plain().extract("sigma", dimension));
  const auto n = static_cast<std::size_t>(atom->ntypes);
  std::vector<dch::LennardJonesPair> matrix(n * n, dch::LennardJonesPair{0, 1, 0});
  dch::CoulombTerm coulomb;
  coulomb.constant = force->qqrd2e;
  if (charges_ == Charges::ewald) coulomb.splitting = force->kspace->g_ewald;
  coulomb.cutoffs.assign(n * n, 0);
  for (const PairOfTypes& p : pairs) {
    const auto a = static_cast<std::size_t>(p.a - 1), b = static_cast<std::size_t>(p.b - 1);
    matrix[a * n + b] =
        matrix[b * n + a] = {epsilon[p.a][p.b], sigma[p.a][p.b], cutoff_of(Part::lennard_jones, p)};
    coulomb.cutoffs[a * n + b] = coulomb.cutoffs[b * n + a] = cutoff_of(Part::coulomb, p);
  }
  kernel_ = std::make_unique<dch::LennardJones>(atom->ntypes, matrix, shifts_energy());
  if (has_charges()) kernel_->set_coulomb(coulomb);
}

void PairLJDCH::add_forces(const ClusterList& wanted, dch::ForcePrecision precision,
                           dch::Span<dch::Vec3> forces, bool with_sums) {
  dch::Span<const double> charges;
  if (has_charges()) charges = {atom->q, wanted.points()};
  dch::LennardJonesSums sums;
  kernel_->set_executor(NeighborDCH::install(lmp)->executor());
  if (wanted.one_by_one) {
    const auto x = positions(wanted);
    if (with_sums) {
      sums = kernel_->add_forces_and_sum(wanted.pair_list, x, box(wanted), forces, charges);
    } else {
      kernel_->add_forces(wanted.pair_list, x, box(wanted), forces, charges);
    }
  } else if (with_sums) {
    sums = kernel_->add_forces_and_sum(wanted.pairs, precision, forces, charges);
  } else {
    kernel_->add_forces(wanted.pairs, precision, forces, charges);
  }
  eng_vdwl += sums.energy;
  eng_coul += sums.coulomb_energy;
  for (int k = 0; k < 6; ++k) virial[k] += sums.virial[static_cast<std::size_t>(k)];
}

}  // namespace LAMMPS_NS
