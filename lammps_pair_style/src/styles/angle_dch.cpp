// SPDX-License-Identifier: GPL-2.0-or-later
#include "angle_dch.h"

#include <array>
#include <atom.h>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <neighbor.h>

#include <dch/base/error.hpp>

#include "stock_name.h"

namespace LAMMPS_NS {

AngleDCH::AngleDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients)
    : Angle(lammps), plain_("Angle", plain_style, coefficients) {
  int has_suffix = 0;
  plain_.take(force->new_angle(dch::lammps::stock_name(*force->angle_map, plain_style), 0, has_suffix),
              *error);
  writedata = plain_->writedata;
  centroidstressflag = plain_->centroidstressflag;
}

AngleDCH::~AngleDCH() {
  if (allocated && !copymode) memory->destroy(setflag);
}

void AngleDCH::coeff(int narg, char** arg) {
  plain_->coeff(narg, arg);
  take_coefficients();
}

void AngleDCH::read_restart(FILE* file) {
  plain_->read_restart(file);
  take_coefficients();
}

void AngleDCH::take_coefficients() {
  kernel_.reset();
  plain_.copy_flags(atom->nangletypes, setflag, allocated, *memory);
}

void AngleDCH::init_style() {
  turns_ = {};
  plain_->init_style();
  kernel_.reset();
}

double AngleDCH::equilibrium_angle(int type) { return plain_->equilibrium_angle(type); }
void AngleDCH::write_restart(FILE* file) { plain_->write_restart(file); }
void AngleDCH::write_data(FILE* file) { plain_->write_data(file); }
double AngleDCH::single(int type, int i, int apex, int k) { return plain_->single(type, i, apex, k); }
double AngleDCH::memory_usage() { return plain_->memory_usage(); }

dch::lammps::StyleNote AngleDCH::explain() const {
  const char* const why = force->newton_bond ? "at steps that want energies, or virials by atom"
                                             : "newton is off for bonds; give 'newton on'";
  return {"angle " + plain_.name(), describe(turns_, why)};
}

void AngleDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const bool by_atom = (vflag & ~(VIRIAL_PAIR | VIRIAL_FDOTR)) != 0;
  if (eflag_either || by_atom || !force->newton_bond) {
    ++turns_.by_plain;
    compute_plain(eflag, vflag);
    return;
  }
  ++turns_.by_kernel;
  if (neighbor->nanglelist == 0) return;
  try {
    if (!kernel_) kernel_ = make_kernel(plain_.coefficients(atom->nangletypes, *error));
    const auto points = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
    std::array<double, 6> sums{};
    kernel_->add_forces({reinterpret_cast<const dch::AngleOfType*>(neighbor->anglelist[0]),
                         static_cast<std::size_t>(neighbor->nanglelist)},
                        1, {reinterpret_cast<const dch::Vec3*>(atom->x[0]), points},
                        {reinterpret_cast<dch::Vec3*>(atom->f[0]), points}, vflag_either ? &sums : nullptr);
    if (vflag_either) std::copy(sums.begin(), sums.end(), virial);
  } catch (const dch::Error& e) {
    error->one(FLERR, plain_.title() + ": " + e.what());
  }
}

void AngleDCH::compute_plain(int eflag, int vflag) {
  plain_->compute(eflag, vflag);
  const int atoms = atom->nlocal + (force->newton_bond ? atom->nghost : 0);
  plain_.copy_sums(atoms, energy, virial, eflag_atom ? eatom : nullptr, vflag_atom ? vatom : nullptr);
  if (cvflag_atom) plain_.copy_rows(atoms, plain_->cvatom, 9, cvatom);
}

}  // namespace LAMMPS_NS
