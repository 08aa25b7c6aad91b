// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>

#include "pair_lj_dch.h"

namespace LAMMPS_NS {

/// A pair style of ours, as LAMMPS and its command `plugin load` want to know it.
struct PairStyle {
  const char* name;
  const char* info;
  Pair* (*create)(LAMMPS* lammps);
};

inline constexpr PairStyle kPairStyles[] = {
    {"lj/cut/dch", "lj/cut on cluster pairs of a discrete center hierarchy",
     [](LAMMPS* lammps) -> Pair* { return new PairLJDCH(lammps, "lj/cut", PairLJDCH::Charges::none); }},
    {"lj/cut/coul/cut/dch", "lj/cut/coul/cut on cluster pairs of a discrete center hierarchy",
     [](LAMMPS* lammps) -> Pair* {
       return new PairLJDCH(lammps, "lj/cut/coul/cut", PairLJDCH::Charges::cut);
     }},
    {"lj/cut/coul/long/dch", "lj/cut/coul/long on cluster pairs of a discrete center hierarchy",
     [](LAMMPS* lammps) -> Pair* {
       return new PairLJDCH(lammps, "lj/cut/coul/long", PairLJDCH::Charges::ewald);
     }},
};

}  // namespace LAMMPS_NS
