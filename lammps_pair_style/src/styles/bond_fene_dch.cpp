// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_fene_dch.h"

#include <algorithm>
#include <atom.h>
#include <cstdio>
#include <cstdlib>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <neighbor.h>
#include <string>

#include <dch/base/error.hpp>

namespace LAMMPS_NS {

BondFENEDCH::BondFENEDCH(LAMMPS* lammps) : Bond(lammps) {
  int has_suffix = 0;
  plain_.reset(force->new_bond("fene", 0, has_suffix));
  if (!plain_)
    error->all(
        FLERR,
        std::string("Bond style fene/dch needs the bond style fene, which this LAMMPS was built without"));
  writedata = plain_->writedata;
  reinitflag = plain_->reinitflag;
}

BondFENEDCH::~BondFENEDCH() {
  if (allocated && !copymode) memory->destroy(setflag);
}

void BondFENEDCH::coeff(int narg, char** arg) {
  plain_->coeff(narg, arg);
  take_coefficients();
}

void BondFENEDCH::read_restart(FILE* file) {
  plain_->read_restart(file);
  take_coefficients();
}

/// LAMMPS looks at which types have been given.
void BondFENEDCH::take_coefficients() {
  kernel_.reset();
  if (!plain_->allocated) return;
  const int n = atom->nbondtypes;
  if (!allocated) {
    allocated = 1;
    memory->create(setflag, n + 1, "bond:setflag");
  }
  std::copy_n(plain_->setflag, n + 1, setflag);
}

void BondFENEDCH::init_style() {
  plain_->init_style();
  kernel_.reset();
}

void BondFENEDCH::reinit() {
  plain_->reinit();
  kernel_.reset();
}

double BondFENEDCH::equilibrium_distance(int type) { return plain_->equilibrium_distance(type); }
void BondFENEDCH::write_restart(FILE* file) { plain_->write_restart(file); }
void BondFENEDCH::write_data(FILE* file) { plain_->write_data(file); }
void* BondFENEDCH::extract(const char* name, int& dimension) { return plain_->extract(name, dimension); }
double BondFENEDCH::memory_usage() { return plain_->memory_usage(); }

double BondFENEDCH::single(int type, double rsq, int i, int j, double& fforce) {
  return plain_->single(type, rsq, i, j, fforce);
}

/// The plain style keeps its coefficients to itself, but writes them to restart files: k, r0, epsilon and
/// sigma, each of all types.
void BondFENEDCH::make_kernel() {
  const auto n = static_cast<std::size_t>(atom->nbondtypes);
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const file = open_memstream(&text, &size);
  if (!file) error->one(FLERR, std::string("Bond style fene/dch: out of memory"));
  plain_->write_restart(file);
  std::fclose(file);
  std::vector<double> values(4 * n);
  const bool fits = size == values.size() * sizeof(double);
  if (fits) std::copy_n(text, size, reinterpret_cast<char*>(values.data()));
  std::free(text);
  if (!fits)
    error->one(
        FLERR,
        std::string("Bond style fene/dch does not know the restart data of this LAMMPS's bond style fene; "
                    "use that"));
  std::vector<dch::FeneBond> types;
  for (std::size_t k = 0; k < n; ++k)
    types.push_back({values[k], values[n + k], values[2 * n + k], values[3 * n + k]});
  kernel_ = std::make_unique<dch::FeneForces>(types);
}

void BondFENEDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const bool by_atom = (vflag & ~(VIRIAL_PAIR | VIRIAL_FDOTR)) != 0;
  if (eflag_either || by_atom || !force->newton_bond) {
    compute_plain(eflag, vflag);
    return;
  }
  if (neighbor->nbondlist == 0) return;
  try {
    if (!kernel_) make_kernel();
    const auto points = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
    std::array<double, 6> sums{};
    const dch::Span<const dch::BondOfType> bonds{
        reinterpret_cast<const dch::BondOfType*>(neighbor->bondlist[0]),
        static_cast<std::size_t>(neighbor->nbondlist)};
    kernel_->add_forces(bonds, 1, {reinterpret_cast<const dch::Vec3*>(atom->x[0]), points},
                        {reinterpret_cast<dch::Vec3*>(atom->f[0]), points}, too_long_,
                        vflag_either ? &sums : nullptr);
    for (const std::int32_t k : too_long_) add_long_bond(bonds[static_cast<std::size_t>(k)], sums);
    if (vflag_either) std::copy(sums.begin(), sums.end(), virial);
  } catch (const dch::Error& e) {
    error->one(FLERR, std::string("Bond style fene/dch: ") + e.what());
  }
}

void BondFENEDCH::compute_plain(int eflag, int vflag) {
  plain_->compute(eflag, vflag);
  energy = plain_->energy;
  std::copy_n(plain_->virial, 6, virial);
  const int atoms = atom->nlocal + (force->newton_bond ? atom->nghost : 0);
  if (eflag_atom) std::copy_n(plain_->eatom, atoms, eatom);
  if (vflag_atom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain_->vatom[i], 6, vatom[i]);
}

/// The plain style warns, or stops if it breaks.
void BondFENEDCH::add_long_bond(const dch::BondOfType& bond, std::array<double, 6>& sums) {
  const double *xi = atom->x[bond.i], *xj = atom->x[bond.j];
  const dch::Vec3 d{xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]};
  double over_r = 0;
  plain_->single(bond.type, norm2(d), bond.i, bond.j, over_r);
  const dch::Vec3 pull = over_r * d;
  double *of_i = atom->f[bond.i], *of_j = atom->f[bond.j];
  for (int axis = 0; axis < 3; ++axis) {
    of_i[axis] += pull[axis];
    of_j[axis] -= pull[axis];
    sums[static_cast<std::size_t>(axis)] += d[axis] * pull[axis];
  }
  sums[3] += d.x * pull.y;
  sums[4] += d.x * pull.z;
  sums[5] += d.y * pull.z;
}

}  // namespace LAMMPS_NS
