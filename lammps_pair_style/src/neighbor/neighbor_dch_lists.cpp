// SPDX-License-Identifier: GPL-2.0-or-later
// Which lists are ours, and what to call them.
#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <compute.h>
#include <fix.h>
#include <force.h>
#include <neigh_list.h>
#include <pair.h>
#include <utility>

#include "ghosts_sent.h"
#include "lammps_versions.h"
#include "neighbor_dch.h"

namespace LAMMPS_NS {

using namespace NeighConst;
using dch::lammps::Obstacle;

namespace {

// Which list LAMMPS makes this one from; empty if from none.
std::string derivation(const NeighList& list) {
  if (list.listcopy) return "a copy of list " + std::to_string(list.listcopy->index + 1);
  if (list.listfull) return "the half of list " + std::to_string(list.listfull->index + 1);
  if (list.listskip) return "a part of list " + std::to_string(list.listskip->index + 1);
  return {};
}

Obstacle levels_of_respa() {
  return {"inner and middle levels of r-RESPA", "all pair forces one level ('run_style respa ... pair N')"};
}

}  // namespace

/// Marks a list and those that LAMMPS makes it from.
void NeighborDCH::mark_needed(const NeighList* list, std::vector<char>& marks) const {
  if (!list || std::exchange(marks[static_cast<std::size_t>(list->index)], 1)) return;
  mark_needed(list->listcopy, marks);
  mark_needed(list->listskip, marks);
  mark_needed(list->listfull, marks);
}

/// Which lists are there for `dch verify` alone: those that styles with cluster pairs have asked for, and
/// what only these are made from. LAMMPS may make a list that others read from one of them.
void NeighborDCH::classify_references() {
  const auto n = static_cast<std::size_t>(nlist);
  std::vector<char> verified(n, 0);
  needed_.assign(n, 0);
  for (int m = 0; m < nlist; ++m) {
    const NeighList& list = *lists[m];
    const auto asks = [&](const ServedClusters& clusters) {
      return list.requestor_type == NeighList::PAIR && list.requestor == clusters.asker && !list.occasional;
    };
    const auto asked = std::find_if(clusters_.begin(), clusters_.end(), asks);
    if (asked != clusters_.end() && (list.respainner || list.respamiddle || list.respaouter)) {
      asked->list->by_levels = true;
      mark_needed(&list, needed_);
    } else if (asked != clusters_.end()) {
      asked->reference = m;
      mark_needed(&list, verified);
    } else if (list.requestor_type != NeighList::NONE || list.occasional) {
      mark_needed(&list, needed_);
    }
  }
  needed_plist_.clear();
  verified_plist_.clear();
  for (int k = 0; k < npair_perpetual; ++k) {
    const int m = plist[k];
    if (is_needed(m)) needed_plist_.push_back(m);
    const bool ours = enabled_ && is_needed(m) && native_reason(*lists[m]).empty();
    if (ours || verified[static_cast<std::size_t>(m)]) verified_plist_.push_back(m);
  }
}

/// Of styles whose forces r-RESPA splits, which their lists say, the plain style computes.
void NeighborDCH::give_up_clusters_by_levels() {
  const auto by_levels = [](const ServedClusters& clusters) { return clusters.list->by_levels; };
  for (const ServedClusters& clusters : clusters_) {
    const Obstacle obstacle = by_levels(clusters) ? levels_of_respa() : Obstacle();
    notes_.push_back({0, clusters.owner + (obstacle.empty() ? ", cluster pairs" : " without cluster pairs"),
                      obstacle.reason, obstacle.remedy});
  }
  clusters_.erase(std::remove_if(clusters_.begin(), clusters_.end(), by_levels), clusters_.end());
}

void NeighborDCH::classify_lists() {
  served_plist_.clear();
  native_plist_.clear();
  std::vector<ServedList> served;
  for (const int m : needed_plist_) {
    const NeighList& list = *lists[m];
    if (!enabled_ || !native_reason(list).empty()) {
      native_plist_.push_back(m);
      continue;
    }
    const int mask = pairmasks[list.pair_method - 1];
    ServedList ours;
    ours.index = m;
    ours.full = (mask & NP_FULL) != 0;
    ours.newton = !ours.full && !(mask & NP_NEWTOFF);
    ours.ghost = list.ghost != 0;
    ours.by_radius = (mask & NP_SIZE) != 0;
    ours.history = ours.by_radius && list.history != 0;
    const auto old =
        std::find_if(served_.begin(), served_.end(), [&](const ServedList& s) { return s.index == m; });
    if (old != served_.end()) {
      ours.rows = std::move(old->rows);
      ours.by_atom = std::move(old->by_atom);
      if (list.respainner) ours.inner = std::move(old->inner);
      if (list.respamiddle) ours.middle = std::move(old->middle);
    }
    served.push_back(std::move(ours));
    served_plist_.push_back(m);
  }
  served_ = std::move(served);
  for (int m = 0; m < nlist && enabled_; ++m) {
    if (lists[m]->pair_method == 0) continue;
    const Obstacle obstacle =
        is_needed(m) ? native_reason(*lists[m])
                     : Obstacle{verifies() ? "for dch verify alone" : "not built, as nobody reads it", {}};
    notes_.push_back({m + 1, list_name(*lists[m]), obstacle.reason, obstacle.remedy});
  }
}

std::string NeighborDCH::list_name(const NeighList& list) const {
  std::string owner = "parent of skip lists";
  if (list.requestor_type == NeighList::PAIR) {
    const char* keyword = force->pair_match_ptr(static_cast<Pair*>(list.requestor));
    owner = std::string("pair ") + (keyword ? keyword : force->pair_style);
  } else if (list.requestor_type == NeighList::FIX) {
    owner = std::string("fix ") + static_cast<Fix*>(list.requestor)->style;
  } else if (list.requestor_type == NeighList::COMPUTE) {
    owner = std::string("compute ") + static_cast<Compute*>(list.requestor)->style;
  }
  const int mask = pairmasks[list.pair_method - 1];
  const bool full = (mask & NP_FULL) != 0;
  if (full && (mask & NP_HALF)) return owner;  // a builder of derived lists, which takes either kind
  const std::string kind = full ? ", full" : mask & NP_NEWTOFF ? ", half, newton off" : ", half, newton on";
  const std::string levels = !list.respainner   ? ""
                             : list.respamiddle ? ", with inner and middle levels"
                                                : ", with an inner level";
  return owner + kind + (list.ghost ? ", with ghost rows" : "") + levels;
}

/// What the builder that LAMMPS has chosen for a list does that ours do not.
Obstacle NeighborDCH::reason_of_style(const NeighList& list) const {
  const int mask = pairmasks[list.pair_method - 1];
  if (mask & NP_SIZE && !atom->radius_flag) return {"cutoffs by radius, but atoms have none", {}};
  if (mask & (NP_ONESIDE | NP_OFF2ON)) return {"one-sided", {}};
  if (mask & NP_BOND) return {"bonds in the list", {}};
  if (mask & (NP_SSA | NP_INTEL | NP_KOKKOS_DEVICE | NP_KOKKOS_HOST))
    return {"layout of an accelerator package", "'suffix off' before the style"};
  const bool of_sub_style = list.requestor_type == NeighList::PAIR && list.requestor != force->pair;
  if (of_sub_style && !(mask & NP_SIZE) && cutneighmin < cutneighmax &&
      dch::lammps::wants_own_cutoff(*static_cast<const Pair*>(list.requestor)))
    return {"one cutoff for all types, by pair_style hybrid (pair_modify neigh/trim)",
            "'pair_modify neigh/trim no'"};
  if (mask & (NP_COPY | NP_SKIP | NP_HALF_FULL)) return {"derived from another list", {}};
  return {};
}

/// What the script says that keeps lists from being ours.
Obstacle NeighborDCH::reason_of_settings(const NeighList& list) const {
  if (force->pair_match("kim", 0) || force->pair_match("kim", 0, 1))
    return {"pair kim sets cutoffs of its own", {}};
  if (!atom->tag_enable) return {"atoms have no IDs (atom_modify id no)", "'atom_modify id yes'"};
  // Which of its pairs LAMMPS loses depends on the side that its own builder would store them on.
  if (GhostsSent::of_one_group(*comm))
    return {"ghosts of one group only (comm_modify group)", "'comm_modify group all'"};
  if (!(cutneighmax > 0)) return {"no cutoff", {}};
  if (!list.ghost) return {};
  if (includegroup) return {"ghost rows with neigh_modify include", "'neigh_modify include all'"};
  // No style of the packages that the adapter is tested with asks for one.
  if (!(pairmasks[list.pair_method - 1] & NP_FULL)) return {"half list with ghost rows", {}};
  for (int a = 1; a <= atom->ntypes; ++a)
    for (int b = 1; b <= atom->ntypes; ++b)
      if (cutneighghostsq[a][b] > cutneighmaxsq) return {"ghost cutoff beyond the largest cutoff", {}};
  return {};
}

Obstacle NeighborDCH::native_reason(const NeighList& list) const {
  if (list.occasional) return {"built on demand only", {}};
  if (std::string from = derivation(list); !from.empty()) return {from, {}};
  if (Obstacle kind = reason_of_style(list); !kind.empty()) return kind;
  if (list.requestor_type == NeighList::FIX || list.requestor_type == NeighList::COMPUTE) {
    return {"asked for by a " + std::string(list.requestor_type == NeighList::FIX ? "fix" : "compute") +
                ", maybe with a cutoff of its own",
            {}};
  }
  return reason_of_settings(list);
}

std::shared_ptr<ClusterList> NeighborDCH::request_clusters(const Pair& asker, const std::string& style_name,
                                                           const Obstacle& obstacle) {
  const std::string owner = "pair " + style_name;
  if (!obstacle.empty()) {
    requested_notes_.push_back({0, owner + " without cluster pairs", obstacle.reason, obstacle.remedy});
    return nullptr;
  }
  auto clusters = std::make_shared<ClusterList>();
  const auto n = static_cast<std::size_t>(atom->ntypes);
  clusters->interacts.assign(n * n, 0);
  requested_clusters_.push_back({clusters, &asker, owner});
  return clusters;
}

Obstacle NeighborDCH::obstacle_to_choice() const {
  if (!enabled_) return {"'dch off' was given", "'dch on'"};
  if (!wants_styles_) return {"'dch styles no' was given", "'dch styles auto'"};
  return {};
}

Obstacle NeighborDCH::obstacle_to_styles() const {
  if (Obstacle choice = obstacle_to_choice(); !choice.empty()) return choice;
  if (engine_ == "grid") return {"the engine grid makes no cluster pairs", "'dch on engine auto'"};
  return {};
}

void NeighborDCH::announce(const std::vector<dch::lammps::ListNote>& before) const {
  if (notes_ == before || comm->me != 0) return;
  utils::logmesg(lmp, "DCH neighbor lists: " + std::to_string(served_.size() + clusters_.size()) + " of " +
                          std::to_string(notes_.size()) + " lists; 'dch stats' says which\n");
}

}  // namespace LAMMPS_NS
