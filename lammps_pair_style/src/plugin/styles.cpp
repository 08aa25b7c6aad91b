// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles.h"

#include <comm.h>
#include <force.h>
#include <modify.h>
#include <string>
#include <type_traits>
#include <utils.h>

#include "angle_cosine_dch.h"
#include "angle_harmonic_dch.h"
#include "bond_fene_dch.h"
#include "bond_harmonic_dch.h"
#include "compute_dch_work.h"
#include "compute_necklace_contact.h"
#include "explained.h"
#include "fix_langevin_dch.h"
#include "fix_langevin_philox.h"
#include "fix_necklace_crossing.h"
#include "fix_nve_dch.h"
#include "pair_buck_dch.h"
#include "pair_charmm_dch.h"
#include "pair_colloid_dch.h"
#include "pair_dpd_philox.h"
#include "pair_eam_dch.h"
#include "pair_gran_dch.h"
#include "pair_lj_dch.h"
#include "pair_morse_dch.h"
#include "pair_soft_dch.h"
#include "pair_table_dch.h"
#include "pair_yukawa_dch.h"

namespace LAMMPS_NS {
namespace {

template <class Base, class Made, class... Arguments>
Base* create(LAMMPS* lmp, Arguments... arguments) {
  return new Made(lmp, arguments...);
}

template <class Base, class Made, class... Arguments>
Base* create_chosen(LAMMPS* lmp, Arguments... arguments) {
  Made* const made = new Made(lmp, arguments...);
  if constexpr (std::is_base_of_v<Explained, Made>) {
    made->choose();
    if (lmp->comm->me == 0)
      utils::logmesg(lmp, "DCH takes " + made->explain().name +
                              " in place of the plain style ('dch styles no' before it: none)\n");
  }
  return made;
}

}  // namespace

// In LAMMPS's own tree its build reads the same lines of the same headers, in the same way.

std::vector<StyleEntry<Pair>> pair_styles_dch() {
  std::vector<StyleEntry<Pair>> styles;
#define PAIR_CLASS
#define PairStyle(key, Made) styles.push_back({#key, &create<Pair, Made>, &create_chosen<Pair, Made>})
#include "pair_buck_dch.h"
#include "pair_charmm_dch.h"
#include "pair_colloid_dch.h"
#include "pair_dpd_philox.h"
#include "pair_eam_dch.h"
#include "pair_gran_dch.h"
#include "pair_lj_dch.h"
#include "pair_morse_dch.h"
#include "pair_soft_dch.h"
#include "pair_table_dch.h"
#include "pair_yukawa_dch.h"
#undef PairStyle
#undef PAIR_CLASS
  return styles;
}

std::vector<StyleEntry<Bond>> bond_styles_dch() {
  std::vector<StyleEntry<Bond>> styles;
#define BOND_CLASS
#define BondStyle(key, Made) styles.push_back({#key, &create<Bond, Made>, &create_chosen<Bond, Made>})
#include "bond_fene_dch.h"
#include "bond_harmonic_dch.h"
#undef BondStyle
#undef BOND_CLASS
  return styles;
}

std::vector<StyleEntry<Angle>> angle_styles_dch() {
  std::vector<StyleEntry<Angle>> styles;
#define ANGLE_CLASS
#define AngleStyle(key, Made) styles.push_back({#key, &create<Angle, Made>, &create_chosen<Angle, Made>})
#include "angle_cosine_dch.h"
#include "angle_harmonic_dch.h"
#undef AngleStyle
#undef ANGLE_CLASS
  return styles;
}

std::vector<StyleEntry<Compute, int, char**>> compute_styles_dch() {
  std::vector<StyleEntry<Compute, int, char**>> styles;
#define COMPUTE_CLASS
#define ComputeStyle(key, Made) \
  styles.push_back({#key, &create<Compute, Made, int, char**>, &create_chosen<Compute, Made, int, char**>})
#include "compute_dch_work.h"
#include "compute_necklace_contact.h"
#include "explained.h"
#undef ComputeStyle
#undef COMPUTE_CLASS
  return styles;
}

std::vector<StyleEntry<Fix, int, char**>> fix_styles_dch() {
  std::vector<StyleEntry<Fix, int, char**>> styles;
#define FIX_CLASS
#define FixStyle(key, Made) \
  styles.push_back({#key, &create<Fix, Made, int, char**>, &create_chosen<Fix, Made, int, char**>})
#include "fix_langevin_dch.h"
#include "fix_langevin_philox.h"
#include "fix_necklace_crossing.h"
#include "fix_nve_dch.h"
#undef FixStyle
#undef FIX_CLASS
  return styles;
}

void register_styles_dch(LAMMPS& lmp) {
  for (const auto& style : pair_styles_dch()) lmp.force->pair_map->emplace(style.name, style.create);
  for (const auto& style : bond_styles_dch()) lmp.force->bond_map->emplace(style.name, style.create);
  for (const auto& style : angle_styles_dch()) lmp.force->angle_map->emplace(style.name, style.create);
  for (const auto& style : compute_styles_dch()) lmp.modify->compute_map->emplace(style.name, style.create);
  for (const auto& style : fix_styles_dch()) lmp.modify->fix_map->emplace(style.name, style.create);
}

}  // namespace LAMMPS_NS
