// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_styles.h"

#include <force.h>

#include "bond_fene_dch.h"
#include "pair_lj_dch.h"

namespace LAMMPS_NS {
namespace {

template <class Base, class Style>
Base* create(LAMMPS* lmp) {
  return new Style(lmp);
}

}  // namespace

// In LAMMPS's own tree its build reads the same lines of the same headers, in the same way.

std::vector<ForceStyle<Pair>> pair_styles_dch() {
  std::vector<ForceStyle<Pair>> styles;
#define PAIR_CLASS
#define PairStyle(key, Style) styles.push_back({#key, &create<Pair, Style>})
#include "pair_lj_dch.h"
#undef PairStyle
#undef PAIR_CLASS
  return styles;
}

std::vector<ForceStyle<Bond>> bond_styles_dch() {
  std::vector<ForceStyle<Bond>> styles;
#define BOND_CLASS
#define BondStyle(key, Style) styles.push_back({#key, &create<Bond, Style>})
#include "bond_fene_dch.h"
#undef BondStyle
#undef BOND_CLASS
  return styles;
}

void register_styles_dch(LAMMPS& lmp) {
  for (const auto& style : pair_styles_dch()) lmp.force->pair_map->emplace(style.name, style.create);
  for (const auto& style : bond_styles_dch()) lmp.force->bond_map->emplace(style.name, style.create);
}

}  // namespace LAMMPS_NS
