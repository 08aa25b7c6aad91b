// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_dch.h"

#include <atom.h>
#include <force.h>
#include <neighbor.h>

#include "stock_name.h"

namespace LAMMPS_NS {

namespace {

Bond* make_plain_bond(Force& force, const char* name) {
  int has_suffix = 0;
  return force.new_bond(dch::lammps::stock_name(*force.bond_map, name), 0, has_suffix);
}

}  // namespace

BondDCH::BondDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients)
    : BondedDCH(lammps, {"bond", plain_style, coefficients, make_plain_bond(*lammps->force, plain_style),
                         *lammps->error}) {
  reinitflag = plain_->reinitflag;
}

void BondDCH::reinit() {
  plain_->reinit();
  forget_kernel();
}

int BondDCH::types() const { return atom->nbondtypes; }
int BondDCH::bonds_here() const { return neighbor->nbondlist; }

dch::Span<const dch::BondOfType> BondDCH::bonds() const {
  return {reinterpret_cast<const dch::BondOfType*>(neighbor->bondlist[0]),
          static_cast<std::size_t>(neighbor->nbondlist)};
}

double BondDCH::equilibrium_distance(int type) { return plain_->equilibrium_distance(type); }
void* BondDCH::extract(const char* name, int& dimension) { return plain_->extract(name, dimension); }

double BondDCH::single(int type, double rsq, int i, int j, double& fforce) {
  return plain_->single(type, rsq, i, j, fforce);
}

}  // namespace LAMMPS_NS
