// SPDX-License-Identifier: GPL-2.0-or-later
#include "angle_dch.h"

#include <atom.h>
#include <force.h>
#include <neighbor.h>

#include "stock_name.h"

namespace LAMMPS_NS {

namespace {

Angle* make_plain_angle(Force& force, const char* name) {
  int has_suffix = 0;
  return force.new_angle(dch::lammps::stock_name(*force.angle_map, name), 0, has_suffix);
}

}  // namespace

AngleDCH::AngleDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients)
    : BondedDCH(lammps, {"angle", plain_style, coefficients, make_plain_angle(*lammps->force, plain_style),
                         *lammps->error}) {
  centroidstressflag = plain_->centroidstressflag;
}

int AngleDCH::types() const { return atom->nangletypes; }
int AngleDCH::bonds_here() const { return neighbor->nanglelist; }

void AngleDCH::add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces,
                          bool wants_virial, std::array<double, 6>& sums) {
  kernel_->add_forces({reinterpret_cast<const dch::AngleOfType*>(neighbor->anglelist[0]),
                       static_cast<std::size_t>(neighbor->nanglelist)},
                      1, positions, forces, wants_virial ? &sums : nullptr);
}

void AngleDCH::copy_more_sums(int atoms) {
  if (cvflag_atom) plain_.copy_rows(atoms, plain_->cvatom, 9, cvatom);
}

double AngleDCH::equilibrium_angle(int type) { return plain_->equilibrium_angle(type); }
double AngleDCH::single(int type, int i, int apex, int k) { return plain_->single(type, i, apex, k); }

}  // namespace LAMMPS_NS
