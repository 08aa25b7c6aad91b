// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_dch.h"

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

BondDCH::BondDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients)
    : Bond(lammps), name_(plain_style), count_(coefficients) {
  int has_suffix = 0;
  plain_.reset(force->new_bond(plain_style, 0, has_suffix));
  if (!plain_)
    error->all(FLERR, "Bond style " + name_ + "/dch needs the bond style " + name_ +
                          ", which this LAMMPS was built without");
  writedata = plain_->writedata;
  reinitflag = plain_->reinitflag;
}

BondDCH::~BondDCH() {
  if (allocated && !copymode) memory->destroy(setflag);
}

void BondDCH::coeff(int narg, char** arg) {
  plain_->coeff(narg, arg);
  take_coefficients();
}

void BondDCH::read_restart(FILE* file) {
  plain_->read_restart(file);
  take_coefficients();
}

/// LAMMPS looks at which types have been given.
void BondDCH::take_coefficients() {
  has_kernel_ = false;
  if (!plain_->allocated) return;
  const int n = atom->nbondtypes;
  if (!allocated) {
    allocated = 1;
    memory->create(setflag, n + 1, "bond:setflag");
  }
  std::copy_n(plain_->setflag, n + 1, setflag);
}

void BondDCH::init_style() {
  plain_->init_style();
  has_kernel_ = false;
}

void BondDCH::reinit() {
  plain_->reinit();
  has_kernel_ = false;
}

double BondDCH::equilibrium_distance(int type) { return plain_->equilibrium_distance(type); }
void BondDCH::write_restart(FILE* file) { plain_->write_restart(file); }
void BondDCH::write_data(FILE* file) { plain_->write_data(file); }
void* BondDCH::extract(const char* name, int& dimension) { return plain_->extract(name, dimension); }
double BondDCH::memory_usage() { return plain_->memory_usage(); }

double BondDCH::single(int type, double rsq, int i, int j, double& fforce) {
  return plain_->single(type, rsq, i, j, fforce);
}

/// The plain style keeps its coefficients to itself, but writes them to restart files.
std::vector<double> BondDCH::coefficients() {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const file = open_memstream(&text, &size);
  if (!file) error->one(FLERR, "Bond style " + name_ + "/dch: out of memory");
  plain_->write_restart(file);
  std::fclose(file);
  std::vector<double> values(count_ * static_cast<std::size_t>(atom->nbondtypes));
  const bool fits = size == values.size() * sizeof(double);
  if (fits) std::copy_n(text, size, reinterpret_cast<char*>(values.data()));
  std::free(text);
  if (!fits)
    error->one(FLERR, "Bond style " + name_ +
                          "/dch does not know the restart data of this LAMMPS's bond style " + name_ +
                          "; use that");
  return values;
}

void BondDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const bool by_atom = (vflag & ~(VIRIAL_PAIR | VIRIAL_FDOTR)) != 0;
  if (eflag_either || by_atom || !force->newton_bond) {
    compute_plain(eflag, vflag);
    return;
  }
  if (neighbor->nbondlist == 0) return;
  try {
    if (!has_kernel_) make_kernel(coefficients());
    has_kernel_ = true;
    const auto points = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
    std::array<double, 6> sums{};
    add_forces({reinterpret_cast<const dch::BondOfType*>(neighbor->bondlist[0]),
                static_cast<std::size_t>(neighbor->nbondlist)},
               {reinterpret_cast<const dch::Vec3*>(atom->x[0]), points},
               {reinterpret_cast<dch::Vec3*>(atom->f[0]), points}, vflag_either, sums);
    if (vflag_either) std::copy(sums.begin(), sums.end(), virial);
  } catch (const dch::Error& e) {
    error->one(FLERR, "Bond style " + name_ + "/dch: " + e.what());
  }
}

void BondDCH::compute_plain(int eflag, int vflag) {
  plain_->compute(eflag, vflag);
  energy = plain_->energy;
  std::copy_n(plain_->virial, 6, virial);
  const int atoms = atom->nlocal + (force->newton_bond ? atom->nghost : 0);
  if (eflag_atom) std::copy_n(plain_->eatom, atoms, eatom);
  if (vflag_atom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain_->vatom[i], 6, vatom[i]);
}

}  // namespace LAMMPS_NS
