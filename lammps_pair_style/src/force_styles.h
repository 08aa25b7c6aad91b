// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>

#include "bond_fene_dch.h"
#include "pair_lj_dch.h"

namespace LAMMPS_NS {

/// A style of ours, as LAMMPS and its command `plugin load` want to know it.
template <class Base>
struct ForceStyle {
  const char* name;
  const char* info;
  Base* (*create)(LAMMPS* lammps);
};

inline constexpr ForceStyle<Pair> kPairStyles[] = {
    {"lj/cut/dch", "lj/cut on cluster pairs of a discrete center hierarchy",
     [](LAMMPS* lmp) -> Pair* { return new PairLJDCH(lmp, "lj/cut", PairLJDCH::Charges::none); }},
    {"lj/cut/coul/cut/dch", "lj/cut/coul/cut on cluster pairs of a discrete center hierarchy",
     [](LAMMPS* lmp) -> Pair* { return new PairLJDCH(lmp, "lj/cut/coul/cut", PairLJDCH::Charges::cut); }},
    {"lj/cut/coul/long/dch", "lj/cut/coul/long on cluster pairs of a discrete center hierarchy",
     [](LAMMPS* lmp) -> Pair* { return new PairLJDCH(lmp, "lj/cut/coul/long", PairLJDCH::Charges::ewald); }},
};

inline constexpr ForceStyle<Bond> kBondStyles[] = {
    {"fene/dch", "fene with SIMD kernels", [](LAMMPS* lmp) -> Bond* { return new BondFENEDCH(lmp); }},
};

}  // namespace LAMMPS_NS
