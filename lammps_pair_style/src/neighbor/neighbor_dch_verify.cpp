// SPDX-License-Identifier: GPL-2.0-or-later
// `dch verify`.
#include <algorithm>
#include <error.h>
#include <neigh_list.h>
#include <update.h>
#include <utility>

#include "neighbor_dch.h"
#include "neighbor_dch_only.h"

namespace LAMMPS_NS {

bool NeighborDCH::verifies_this_build() const {
  const bool any = fills_lists() ? !verified_plist_.empty()
                                 : std::any_of(clusters_.begin(), clusters_.end(),
                                               [](const ServedClusters& c) { return c.reference >= 0; });
  return any && verify_every_ > 0 && run_.builds % verify_every_ == 0;
}

void NeighborDCH::build_native_reference() {
  const bool were_hidden = bins_hidden_;
  show_bins();
  if (style != NSQ) setup_bins();
  const bigint calls = ncalls;
  const double begin = MPI_Wtime();
  {
    OnlyTheseLists verified(*this, verified_plist_);
    Neighbor::build(0);
  }
  run_.verified_native_seconds += MPI_Wtime() - begin;
  ncalls = calls;
  if (were_hidden) hide_bins();
  native_entries_.clear();
  for (const ServedList& served : served_)
    for (const PairLevel level : levels_of(*lists[served.index]))
      native_entries_.push_back(ListVerifier::entries(*lists[served.index], served, level));
  reference_entries_.clear();
  for (const ServedClusters& clusters : clusters_) {
    reference_entries_.emplace_back();
    if (clusters.reference >= 0)
      reference_entries_.back() = ListVerifier::entries(*lists[clusters.reference], ServedList());
  }
  run_.verified_dch_seconds -= run_.seconds();  // check_against_native() adds it again, this build included
}

void NeighborDCH::check_against_native() {
  run_.verified_dch_seconds += run_.seconds();
  if (fills_lists()) check_lists();
  check_clusters();
  ++run_.verified_builds;
}

void NeighborDCH::check_lists() {
  auto native = native_entries_.begin();
  for (const ServedList& served : served_) {
    const NeighList& list = *lists[served.index];
    for (const PairLevel level : levels_of(list)) {
      const std::string difference =
          verifier_.compare(std::move(*native++), ListVerifier::entries(list, served, level), served, level,
                            images_.error_within(cutneighmax));
      const std::string name =
          list_name(list) + (level == PairLevel::all ? "" : std::string("; the ") + name_of(level));
      if (!difference.empty())
        stop_at("the native and the DCH list (" + name + ") are not the same: " + difference, "'dch off'");
    }
    run_.verified_entries += served.pairs;
  }
}

void NeighborDCH::check_clusters() {
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    if (clusters_[k].reference < 0) continue;
    const ClusterVerifier::Result result = cluster_verifier_.compare(
        reference_entries_[k], *clusters_[k].list, images_.error_within(cutneighmax));
    if (!result.difference.empty())
      stop_at("the native list and the cluster pairs (" + list_name(*lists[clusters_[k].reference]) +
                  ") are not the same: " + result.difference,
              "'suffix off' before the pair style");
    run_.verified_entries += result.compared;
  }
}

void NeighborDCH::stop_at(const std::string& what, const std::string& remedy) const {
  error->all(FLERR, "dch verify: at step " + std::to_string(update->ntimestep) + " " + what + ". Give " +
                        remedy + " to go on with native lists, and please report the script");
}

}  // namespace LAMMPS_NS
