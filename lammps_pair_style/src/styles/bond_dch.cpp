// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_dch.h"

#include <algorithm>
#include <atom.h>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <neighbor.h>

#include <dch/base/error.hpp>

#include "stock_name.h"

namespace LAMMPS_NS {

BondDCH::BondDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients)
    : Bond(lammps), plain_("Bond", plain_style, coefficients) {
  int has_suffix = 0;
  plain_.take(force->new_bond(dch::lammps::stock_name(*force->bond_map, plain_style), 0, has_suffix), *error);
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

void BondDCH::take_coefficients() {
  has_kernel_ = false;
  plain_.copy_flags(atom->nbondtypes, setflag, allocated, *memory);
}

void BondDCH::init_style() {
  turns_ = {};
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

dch::lammps::StyleNote BondDCH::explain() const {
  const char* const why = force->newton_bond ? "at steps that want energies, or virials by atom"
                                             : "newton is off for bonds; give 'newton on'";
  return {"bond " + plain_.name(), describe(turns_, why)};
}

double BondDCH::single(int type, double rsq, int i, int j, double& fforce) {
  return plain_->single(type, rsq, i, j, fforce);
}

void BondDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const bool by_atom = (vflag & ~(VIRIAL_PAIR | VIRIAL_FDOTR)) != 0;
  if (eflag_either || by_atom || !force->newton_bond) {
    ++turns_.by_plain;
    compute_plain(eflag, vflag);
    return;
  }
  ++turns_.by_kernel;
  if (neighbor->nbondlist == 0) return;
  try {
    if (!has_kernel_) make_kernel(plain_.coefficients(atom->nbondtypes, *error));
    has_kernel_ = true;
    const auto points = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
    std::array<double, 6> sums{};
    add_forces({reinterpret_cast<const dch::BondOfType*>(neighbor->bondlist[0]),
                static_cast<std::size_t>(neighbor->nbondlist)},
               {reinterpret_cast<const dch::Vec3*>(atom->x[0]), points},
               {reinterpret_cast<dch::Vec3*>(atom->f[0]), points}, vflag_either, sums);
    if (vflag_either) std::copy(sums.begin(), sums.end(), virial);
  } catch (const dch::Error& e) {
    error->one(FLERR, plain_.title() + ": " + e.what());
  }
}

void BondDCH::compute_plain(int eflag, int vflag) {
  plain_->compute(eflag, vflag);
  const int atoms = atom->nlocal + (force->newton_bond ? atom->nghost : 0);
  plain_.copy_sums(atoms, energy, virial, eflag_atom ? eatom : nullptr, vflag_atom ? vatom : nullptr);
}

}  // namespace LAMMPS_NS
