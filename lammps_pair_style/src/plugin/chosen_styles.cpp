// SPDX-License-Identifier: GPL-2.0-or-later
#include "chosen_styles.h"

#include <force.h>
#include <modify.h>
#include <string>
#include <vector>

#include "stock_name.h"
#include "styles.h"

namespace LAMMPS_NS {
namespace {

using dch::lammps::kStock;

/// The name without this end; empty if it has another one.
std::string without(const std::string& name, const std::string& end) {
  const bool ends = name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  return ends ? name.substr(0, name.size() - end.size()) : std::string();
}

template <class Styles, class Creator>
void take(Styles& styles, const std::string& plain, Creator create) {
  if (styles.count(plain) == 0 || styles.count(plain + kStock) > 0) return;
  styles[plain + kStock] = styles[plain];
  styles[plain] = create;
}

template <class Styles, class Entry>
void take_ours(Styles& styles, const std::vector<Entry>& ours) {
  for (const Entry& style : ours)
    if (const std::string plain = without(style.name, "/dch"); !plain.empty())
      take(styles, plain, style.create_chosen);
}

template <class Styles>
void take_optimized(Styles& styles) {
  const Styles before = styles;
  for (const auto& style : before)
    if (const std::string plain = without(style.first, "/opt"); !plain.empty())
      take(styles, plain, style.second);
}

template <class Styles>
void give_back(Styles& styles) {
  const Styles before = styles;
  for (const auto& style : before) {
    const std::string plain = without(style.first, kStock);
    if (plain.empty()) continue;
    styles[plain] = style.second;
    styles.erase(style.first);
  }
}

}  // namespace

void choose_styles(LAMMPS& lmp, bool ours) {
  Force& force = *lmp.force;
  Modify& modify = *lmp.modify;
  if (ours) {
    take_ours(*force.pair_map, pair_styles_dch());
    take_ours(*force.bond_map, bond_styles_dch());
    take_ours(*force.angle_map, angle_styles_dch());
    take_ours(*modify.fix_map, fix_styles_dch());
    take_optimized(*force.pair_map);
  } else {
    give_back(*force.pair_map);
    give_back(*force.bond_map);
    give_back(*force.angle_map);
    give_back(*modify.fix_map);
  }
}

}  // namespace LAMMPS_NS
