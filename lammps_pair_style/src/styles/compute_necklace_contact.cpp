// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_necklace_contact.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <error.h>
#include <string>
#include <update.h>

#include "finite_number.h"

namespace LAMMPS_NS {
namespace {

const std::string kName = "Compute necklace/contact: ";
constexpr int kMaxSkip = 1000000;

}  // namespace

ComputeNecklaceContact::ComputeNecklaceContact(LAMMPS* lammps, int narg, char** arg)
    : Compute(lammps, narg, arg), map_(lammps), beads_(lammps), bonds_(lammps) {
  if (narg < 4)
    error->all(FLERR,
               kName + "the gap is missing; for example 'compute touch all necklace/contact 0.1 radius 0.5'");
  query_.gap = finite_number(arg[3]);
  if (!(query_.gap >= 0))
    error->all(FLERR, kName + "the gap is '" + arg[3] + "' but has to be a distance of 0 or more");
  read_keywords(narg, arg);
  if (atom->molecular != Atom::MOLECULAR)
    error->all(FLERR, kName + "the atom style has no bonds of its own; chains need one like bond or full");
  if (radius_of_type_.empty() && !atom->radius_flag)
    error->all(FLERR,
               kName + "this atom style has no radii; give 'radius R', or 'radius' and one for each type");
  scalar_flag = peratom_flag = local_flag = array_flag = 1;
  extscalar = 0;  // a number of contacts, which thermo output does not divide by that of atoms
  size_peratom_cols = 0;
  size_local_cols = 3;
  size_array_rows = 1;
  size_array_cols = static_cast<int>(search_.size());
  extarray = 0;
  dynamic_group_allow = 1;
}

double ComputeNecklaceContact::positive(const char* word, const char* what) {
  const double value = finite_number(word);
  if (!(value > 0)) error->all(FLERR, kName + what + " is '" + word + "' but has to be a number above 0");
  return value;
}

void ComputeNecklaceContact::read_keywords(int narg, char** arg) {
  for (int at = 4; at < narg;) at = read_keyword(narg, arg, at);
}

/// @return where the next keyword stands
int ComputeNecklaceContact::read_keyword(int narg, char** arg, int at) {
  const std::string keyword = arg[at];
  if (keyword != "radius" && keyword != "skip" && keyword != "pairs")
    error->all(FLERR, kName + "unknown keyword '" + keyword + "'; there are radius, skip and pairs");
  if (at + 1 == narg) error->all(FLERR, kName + "'" + keyword + "' lacks its value");
  if (keyword == "radius") return read_radii(narg, arg, at + 1);
  const std::string value = arg[at + 1];
  if (keyword == "skip") {
    const double bonds = finite_number(arg[at + 1]);
    if (!(bonds >= 0 && bonds <= kMaxSkip && bonds == std::floor(bonds)))
      error->all(FLERR, kName + "skip is '" + value + "' but has to be a whole number from 0 to " +
                            std::to_string(kMaxSkip));
    query_.skip_bonds = static_cast<int>(bonds);
  } else {
    if (value != "all" && value != "within" && value != "between")
      error->all(FLERR, kName + "pairs is '" + value + "' but has to be all, within or between");
    query_.within_chains = value != "between";
    query_.between_chains = value != "within";
  }
  return at + 2;
}

/// One number for all types, or one for each: as many as there are up to the next keyword.
/// @return where the next keyword stands
int ComputeNecklaceContact::read_radii(int narg, char** arg, int at) {
  std::vector<double> radii;
  for (; at < narg && (radii.empty() || !std::isnan(finite_number(arg[at]))); ++at)
    radii.push_back(positive(arg[at], "a radius"));
  const auto types = static_cast<std::size_t>(atom->ntypes);
  if (radii.size() != 1 && radii.size() != types)
    error->all(FLERR, kName + std::to_string(radii.size()) + " radii for " + std::to_string(types) +
                          " atom types; give one for all, or one for each");
  radius_of_type_.assign(types + 1, radii.front());
  if (radii.size() == types) std::copy(radii.begin(), radii.end(), radius_of_type_.begin() + 1);
  return at;
}

void ComputeNecklaceContact::init() { found_at_ = -1; }

/// Results asked for at one step share a search; one that asks again at the same step does so because
/// something has moved the atoms.
void ComputeNecklaceContact::find_for(Result asked) {
  bool& taken = taken_[static_cast<std::size_t>(asked)];
  if (found_at_ != update->ntimestep || taken) {
    find();
    found_at_ = update->ntimestep;
    taken_.fill(false);
  }
  taken = true;
}

double ComputeNecklaceContact::compute_scalar() {
  invoked_scalar = update->ntimestep;
  find_for(Result::scalar);
  return scalar = static_cast<double>(total_);
}

void ComputeNecklaceContact::compute_peratom() {
  invoked_peratom = update->ntimestep;
  find_for(Result::by_atom);
  std::vector<double> of_bead(beads_.size(), 0.0);
  for (const auto& contact : contacts_) {
    ++of_bead[static_cast<std::size_t>(contact.i)];
    ++of_bead[static_cast<std::size_t>(contact.j)];
  }
  counts_.assign(static_cast<std::size_t>(std::max(1, atom->nmax)), 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const std::ptrdiff_t k = beads_.index_of(map_.bead_of(atom->tag[i]));
    if (k >= 0) counts_[static_cast<std::size_t>(i)] = of_bead[static_cast<std::size_t>(k)];
  }
  vector_atom = counts_.data();
}

void ComputeNecklaceContact::compute_local() {
  invoked_local = update->ntimestep;
  find_for(Result::local);
  const auto tag_of = [this](std::int32_t k) {
    return static_cast<double>(
        map_.tags()[static_cast<std::size_t>(beads_.beads()[static_cast<std::size_t>(k)])]);
  };
  rows_.clear();
  for (const auto& contact : contacts_)
    if (beads_.is_own(static_cast<std::size_t>(contact.i)))
      rows_.push_back({tag_of(contact.i), tag_of(contact.j), contact.gap});
  row_starts_.clear();
  for (auto& row : rows_) row_starts_.push_back(row.data());
  size_local_rows = static_cast<int>(rows_.size());
  array_local = row_starts_.data();
}

/// One row: how the contacts were found, and what processes sent each other for it.
void ComputeNecklaceContact::compute_array() {
  invoked_array = update->ntimestep;
  find_for(Result::search);
  array = &search_row_;
}

double ComputeNecklaceContact::memory_usage() {
  auto bytes = static_cast<double>(counts_.size() * sizeof(double) + rows_.size() * sizeof(rows_[0]) +
                                   contacts_.size() * sizeof(contacts_[0]));
  if (finder_) bytes += static_cast<double>(finder_->memory_bytes());
  return bytes;
}

}  // namespace LAMMPS_NS
