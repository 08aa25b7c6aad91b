// SPDX-License-Identifier: GPL-2.0-or-later
#include "style_notes.h"

#include <algorithm>
#include <angle.h>
#include <bond.h>
#include <dihedral.h>
#include <fix.h>
#include <force.h>
#include <improper.h>
#include <kspace.h>
#include <memory>
#include <modify.h>
#include <pair.h>
#include <string>
#include <typeinfo>

#include "explained.h"
#include "stock_name.h"

namespace LAMMPS_NS {
namespace {

using dch::lammps::StyleNote;

/// Without the suffix of one of LAMMPS's packages.
std::string plain_name(const std::string& name) {
  for (const std::string suffix : {dch::lammps::kStock, "/opt", "/omp", "/intel", "/gpu", "/kk"}) {
    const bool ends =
        name.size() > suffix.size() && name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
    if (ends) return name.substr(0, name.size() - suffix.size());
  }
  return name;
}

/// Whether LAMMPS makes styles of this class by this function, which it does with no more than itself.
template <class Style>
bool is_made_by(Style* (*create)(LAMMPS*), LAMMPS* lmp, const Style& style) {
  const std::unique_ptr<Style> made(create(lmp));
  const Style &first = *made, &second = style;
  return typeid(first) == typeid(second);
}
bool is_made_by(Fix* (*)(LAMMPS*, int, char**), LAMMPS*, const Fix&) { return false; }

/// Of styles that are neither ours nor the plain ones while `dch on` takes others in their place.
template <class Styles, class Style>
bool is_optimized(const Styles& styles, const std::string& name, LAMMPS* lmp, const Style& style) {
  return styles.count(name + dch::lammps::kStock) > 0 && styles.count(name + "/dch") == 0 &&
         is_made_by(styles.at(name), lmp, style);
}

template <class Styles, class Style>
StyleNote note(const Styles& styles, const char* kind, const std::string& name, LAMMPS* lmp,
               const Style& style) {
  if (const auto* explained = dynamic_cast<const Explained*>(&style)) {
    StyleNote own = explained->explain();
    if (styles.count(name + dch::lammps::kStock) > 0)
      own.how += "; taken by 'dch on' in place of " + name + " ('dch styles no')";
    return own;
  }
  const std::string plain = plain_name(name), ours = plain + "/dch", opt = name + "/opt";
  if (is_optimized(styles, name, lmp, style))
    return {kind + opt, "native, taken by 'dch on' in place of " + name + " ('dch styles no')"};
  if (styles.count(ours) > 0 && styles.count(name + dch::lammps::kStock) > 0)
    return {kind + name, "native, as it was made before 'dch on'; give that before it for " + ours};
  if (styles.count(ours) > 0)
    return {kind + name, "native, as the script names it; give 'suffix dch' before it for " + ours};
  std::string how = "native, there is no " + ours;
  if (styles.count(opt) > 0) how += "; give 'suffix opt' before it for " + opt;
  return {kind + name, how};
}

bool is_hybrid(const std::string& name) { return name.compare(0, 6, "hybrid") == 0; }

/// Styles under this one: itself, or those of a hybrid one. LAMMPS finds them by their names alone.
template <class Style, class Styles, class Find>
void add_notes(const Styles& styles, const char* kind, LAMMPS* lmp, Style* style, const char* name,
               const Find& find, std::vector<StyleNote>& notes) {
  if (!style) return;
  if (!is_hybrid(name)) {
    notes.push_back(note(styles, kind, name, lmp, *style));
    return;
  }
  std::vector<Style*> known{style};
  for (const auto& entry : styles) {
    for (int which = 1;; ++which) {
      Style* const found = find(entry.first, which);
      if (!found || std::find(known.begin(), known.end(), found) != known.end()) break;
      known.push_back(found);
      notes.push_back(note(styles, kind, entry.first, lmp, *found));
    }
  }
}

void add_fixes(LAMMPS* lmp, std::vector<StyleNote>& notes) {
  const Modify& modify = *lmp->modify;
  for (int k = 0; k < modify.nfix; ++k) {
    Fix* const fix = modify.fix[k];
    const std::string name = fix->style;
    const std::string kind = std::string("fix ") + fix->id + ", ";
    if (std::isupper(static_cast<unsigned char>(name[0]))) continue;  // LAMMPS's and our own helpers
    StyleNote found = note(*modify.fix_map, "", name, lmp, *fix);
    found.name = kind + found.name;
    notes.push_back(found);
  }
}

}  // namespace

std::vector<StyleNote> style_notes(LAMMPS& lmp) {
  std::vector<StyleNote> notes;
  Force& force = *lmp.force;
  add_notes(
      *force.pair_map, "pair ", &lmp, force.pair, force.pair_style,
      [&](const std::string& name, int which) { return force.pair_match(name, 1, which); }, notes);
  add_notes(
      *force.bond_map, "bond ", &lmp, force.bond, force.bond_style,
      [&](const std::string& name, int) { return force.bond_match(name); }, notes);
  add_notes(
      *force.angle_map, "angle ", &lmp, force.angle, force.angle_style,
      [&](const std::string& name, int) { return force.angle_match(name); }, notes);
  add_notes(
      *force.dihedral_map, "dihedral ", &lmp, force.dihedral, force.dihedral_style,
      [&](const std::string& name, int) { return force.dihedral_match(name); }, notes);
  add_notes(
      *force.improper_map, "improper ", &lmp, force.improper, force.improper_style,
      [&](const std::string& name, int) { return force.improper_match(name); }, notes);
  add_notes(
      *force.kspace_map, "kspace ", &lmp, force.kspace, force.kspace_style,
      [&](const std::string&, int) { return static_cast<KSpace*>(nullptr); }, notes);
  add_fixes(&lmp, notes);
  return notes;
}

}  // namespace LAMMPS_NS
