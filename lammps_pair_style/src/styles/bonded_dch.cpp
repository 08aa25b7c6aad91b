// SPDX-License-Identifier: GPL-2.0-or-later
#include "bonded_dch.h"

#include <algorithm>
#include <angle.h>
#include <atom.h>
#include <bond.h>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <utility>

#include <dch/base/error.hpp>

namespace LAMMPS_NS {

template <class Style>
BondedDCH<Style>::BondedDCH(LAMMPS* lammps, PlainStyle<Style> plain)
    : Style(lammps), plain_(std::move(plain)) {
  this->writedata = plain_->writedata;
}

template <class Style>
BondedDCH<Style>::~BondedDCH() {
  if (this->allocated && !this->copymode) this->memory->destroy(this->setflag);
}

template <class Style>
void BondedDCH<Style>::coeff(int narg, char** arg) {
  plain_->coeff(narg, arg);
  take_coefficients();
}

template <class Style>
void BondedDCH<Style>::read_restart(std::FILE* file) {
  plain_->read_restart(file);
  take_coefficients();
}

template <class Style>
void BondedDCH<Style>::take_coefficients() {
  forget_kernel();
  plain_.copy_flags(types(), this->setflag, this->allocated, *this->memory);
}

template <class Style>
void BondedDCH<Style>::init_style() {
  turns_ = {};
  plain_->init_style();
  forget_kernel();
}

template <class Style>
void BondedDCH<Style>::write_restart(std::FILE* file) {
  plain_->write_restart(file);
}

template <class Style>
void BondedDCH<Style>::write_data(std::FILE* file) {
  plain_->write_data(file);
}

template <class Style>
double BondedDCH<Style>::memory_usage() {
  return plain_->memory_usage();
}

template <class Style>
dch::lammps::StyleNote BondedDCH<Style>::explain() const {
  const char* const why = this->force->newton_bond ? "at steps that want energies, or virials by atom"
                                                   : "newton is off for bonds; give 'newton on'";
  return {plain_.kind() + " " + plain_.name(), describe(turns_, why)};
}

template <class Style>
void BondedDCH<Style>::compute(int eflag, int vflag) {
  this->ev_init(eflag, vflag);
  const bool by_atom = (vflag & ~(VIRIAL_PAIR | VIRIAL_FDOTR)) != 0;
  if (this->eflag_either || by_atom || !this->force->newton_bond) {
    ++turns_.by_plain;
    compute_plain(eflag, vflag);
    return;
  }
  ++turns_.by_kernel;
  if (bonds_here() == 0) return;
  try {
    if (!has_kernel_) make_kernel(plain_.coefficients(types(), *this->error));
    has_kernel_ = true;
    const auto points = static_cast<std::size_t>(this->atom->nlocal + this->atom->nghost);
    std::array<double, 6> sums{};
    add_forces({reinterpret_cast<const dch::Vec3*>(this->atom->x[0]), points},
               {reinterpret_cast<dch::Vec3*>(this->atom->f[0]), points}, this->vflag_either, sums);
    if (this->vflag_either) std::copy(sums.begin(), sums.end(), this->virial);
  } catch (const dch::Error& e) {
    this->error->one(FLERR, plain_.title() + ": " + e.what());
  }
}

template <class Style>
void BondedDCH<Style>::compute_plain(int eflag, int vflag) {
  plain_->compute(eflag, vflag);
  const int atoms = this->atom->nlocal + (this->force->newton_bond ? this->atom->nghost : 0);
  plain_.copy_sums(atoms, this->energy, this->virial, this->eflag_atom ? this->eatom : nullptr,
                   this->vflag_atom ? this->vatom : nullptr);
  copy_more_sums(atoms);
}

template class BondedDCH<Bond>;
template class BondedDCH<Angle>;

}  // namespace LAMMPS_NS
