// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <memory>
#include <neighbor.h>
#include <optional>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "atom_order.h"
#include "atom_points.h"
#include "cluster_list.h"
#include "cluster_verifier.h"
#include "ghost_images.h"
#include "ghost_reach.h"
#include "ghost_sides.h"
#include "list_expiry.h"
#include "list_filler.h"
#include "list_verifier.h"
#include "run_report.h"
#include "skin_tuner.h"
#include "stock_builds.h"

namespace dch::lammps {

/// Makes the engine of a name; dch::make_search, but for tests.
using SearchFactory = std::unique_ptr<PairSearch> (*)(const std::string& engine, const HierarchyParams&);

}  // namespace dch::lammps

namespace LAMMPS_NS {

class Pair;

/// Makes what fills cluster pairs; a ClusterListFiller, but for tests.
using ClusterFillerFactory = std::unique_ptr<ClusterListFiller> (*)(LAMMPS*, SpecialPairs&, const PairRules&);

std::unique_ptr<ClusterListFiller> make_cluster_filler(LAMMPS* lammps, SpecialPairs& special,
                                                       const PairRules& rules);

/// What a NeighborDCH is made of.
struct NeighborParts {
  dch::lammps::SearchFactory search = dch::make_search;
  ClusterFillerFactory cluster_filler = make_cluster_filler;
};

/// LAMMPS's Neighbor with the pairwise lists filled from a discrete center hierarchy or a grid: over the
/// atoms in the periodic box where one process has it, else over owned and ghost atoms.
///
/// It takes the place of the stock object, so every pair style, fix and compute finds its list where it
/// always was. Of the perpetual lists it fills those that LAMMPS would build by searching space for a pair
/// style; LAMMPS goes on to derive skip, copy and half-from-full lists from them, and builds all others
/// itself. Force styles of ours ask for cluster pairs in place of a list. Topology lists and all settings
/// stay the base class's, and so does the displacement test, except that lists that lack no pair are kept.
/// Each process keeps a hierarchy of its own; atoms are named by PointKeys, so that it is repaired, not built
/// anew, when atoms are re-sorted, migrate or cross the box.
class NeighborDCH : public Neighbor {
 public:
  /// Takes over the state of `retired`, which is kept, emptied, until this object goes: parts of LAMMPS point
  /// into it until the next run initializes them. Lists are native until enable().
  NeighborDCH(Neighbor* retired, const NeighborParts& parts);
  ~NeighborDCH() override;
  NeighborDCH(const NeighborDCH&) = delete;
  NeighborDCH& operator=(const NeighborDCH&) = delete;

  /// The NeighborDCH of this LAMMPS, put in the place of its stock Neighbor if there is none yet. Stops
  /// LAMMPS with a message if another class has taken that place.
  static NeighborDCH* install(LAMMPS* lammps, const NeighborParts& parts = {});

  /// From the next run on, lists come from the engine of that name; see dch::make_search. Without a name,
  /// from the one that suits the number of processes.
  void enable(const std::string& engine);
  /// Whether styles of ours take the place of LAMMPS's while lists come from an engine.
  void set_styles(bool taken) { wants_styles_ = taken; }
  bool takes_styles() const { return enabled_ && wants_styles_; }
  /// Why pair styles that have been taken so should leave forces to the plain style; empty if they need not.
  dch::lammps::Obstacle obstacle_to_choice() const;
  /// The same of those on cluster pairs.
  dch::lammps::Obstacle obstacle_to_styles() const;
  /// All lists are native from their next build on.
  void disable();
  /// 0: never; N: at every Nth build of a run, the first included, the native lists are built too and
  /// compared. Cluster pairs are from the next run on, whose pair styles ask for the lists to compare with.
  void set_verify(int interval) { verify_every_ = interval; }
  bool verifies() const { return verify_every_ > 0; }
  /// Threads that each process searches with, from the next run on.
  void set_threads(int threads) { threads_ = threads; }
  /// Those threads; null for one. Good for a run.
  dch::Executor* executor() const { return pool_.get(); }
  /// Whether runs from now on look for the skin with the least time a step, up to that of the script.
  void set_skin_tuning(bool on) { tunes_skin_ = on; }
  /// When lists expire, from the next run on.
  void set_expiry(dch::lammps::ExpiryRule rule) { expiry_rule_ = rule; }
  void set_precision(dch::ForcePrecision precision) { precision_ = precision; }
  dch::ForcePrecision precision() const { return precision_; }  ///< of force styles of ours

  /// Whether runs from now on put atoms in memory in the order of the structure.
  void set_order(dch::lammps::OrderAtoms when) { order_.set_when(when); }
  /// Puts them back in LAMMPS's order, from the same place of the setup of a run.
  void restore_order() { order_.restore(); }
  /// The same between two runs, for what makes ghosts and lists anew.
  void restore_order_between_runs();
  /// Does so, if it is time, from between the decision to build lists and the exchange of atoms.
  void order_atoms();
  /// Has LAMMPS make no ghosts in runs where nothing reads them, from the same place.
  void leave_out_ghosts();

  /// Cluster pairs for the run that is about to begin, kept up at every build of lists from then on; whether
  /// lists come from the hierarchy too or not. From a pair style's init_style(). A half list that the style
  /// asks LAMMPS for beside them is the one that they are compared with; it is built for that alone.
  /// @param obstacle why the style cannot use them, for dch stats; then there are none and null is returned
  std::shared_ptr<ClusterList> request_clusters(const Pair& asker, const std::string& style_name,
                                                const dch::lammps::Obstacle& obstacle);

  /// What the lists of the last run did, over all processes. Every process has to call it.
  dch::lammps::RunReport report() const;

  /// Adds, to the number of each owned atom, the pairs of the lists just built that pair styles go through
  /// for it: neighbors in rows, LAMMPS's own lists included, and pairs of slots of cluster pairs. Both atoms
  /// of a pair have half of it, ghosts too, which are for their owners; with newton off, where the other
  /// process computes the pair as well, the owned one has the whole.
  void count_work(double* work) const;

  void init() override;
  void build(int topoflag) override;
  int check_distance() override;

 private:
  class OnlyTheseLists;
  struct ReliedOn;  ///< what of Neighbor has to be as it was; see relied_on.cpp

  /// Cluster pairs of a style, and the list that they are compared with.
  struct ServedClusters {
    std::shared_ptr<ClusterList> list;
    const void* asker;   ///< the style, as LAMMPS knows who asked for a list
    std::string owner;   ///< its name
    int reference = -1;  ///< in Neighbor::lists; -1 if there is none
  };

  void classify_lists();
  void give_up_clusters_by_levels();
  void classify_references();
  void mark_needed(const NeighList* list, std::vector<char>& marks) const;
  bool is_needed(int m) const { return needed_[static_cast<std::size_t>(m)] != 0; }
  std::string list_name(const NeighList& list) const;
  dch::lammps::Obstacle native_reason(const NeighList& list) const;
  dch::lammps::Obstacle reason_of_style(const NeighList& list) const;
  dch::lammps::Obstacle reason_of_settings(const NeighList& list) const;
  void announce(const std::vector<dch::lammps::ListNote>& before) const;
  void show_bins();
  void hide_bins();
  std::string need_of_ghosts() const;
  std::string reader_of_ghosts() const;
  dch::Span<double> cutoffs_of_ghosts();
  void show_cutoffs();

  void build_native_reference();
  void prepare_search();
  void widen_search();
  double reach() const;
  std::string wanted_engine() const;
  void check_engine_makes_clusters();
  void prepare_skin();
  void choose_skin();
  void apply_skin();
  void prepare_expiry();
  std::string settings_against_expiry() const;
  std::string fix_against_expiry() const;
  std::string uncertain_list() const;
  bool is_as_complete(const NeighList& list) const;
  bool keeps_order() const;
  bool moved_half_skin();
  ListExpiry::Verdict own_verdict();
  bool lists_hold_all();
  ListExpiry::Wanted wanted_pairs() const;
  void note_expiry();
  double builds_saved() const;
  bool choose_size_classes();
  dch::lammps::RunReport settings_of_run() const;
  bool any_by_radius() const;
  bool sizes_differ_much();
  double pairs_of_clusters() const;
  bool fills_lists() const { return enabled_ && !served_.empty(); }
  void build_ours();
  void fill_lists();
  void fill_clusters();
  bool may_use_box() const;
  GhostChoice ghosts_to_search();
  bool leaves_ghosts_to_others() const;
  bool leaves_far_ghosts() const;
  dch::ListParams list_params(const ServedList& served);
  dch::TypeCutoffs type_cutoffs() const;
  double present_skin() const;
  dch::SearchStats search_stats() const { return search_ ? search_->stats() : dch::SearchStats(); }
  bool verifies_this_build() const;
  void check_against_native();
  void check_lists();
  void check_clusters();
  [[noreturn]] void stop_at(const std::string& what, const std::string& remedy) const;

  std::unique_ptr<Neighbor> retired_;
  bool enabled_ = false;
  bool wants_styles_ = true;
  std::string engine_;                 ///< for lists, as it was named; lists that are off leave it no say
  std::string engine_in_use_ = "dch";  ///< that search_ was made as
  std::string engine_reason_;          ///< who wanted it
  int verify_every_ = 0;

  bool bins_hidden_ = false;
  int all_bins_ = 0, all_stencils_ = 0,
      stencils_in_use_ = 0;                           ///< nbin, nstencil, nstencil_perpetual while hidden
  std::string ghosts_for_ = "no DCH list is in use";  ///< why there are ghosts; empty if there are none
  std::vector<double> full_cutoffs_;  ///< cutoffs_of_ghosts() while these are hidden, else none

  std::vector<ServedList> served_;
  std::vector<int> served_plist_;  ///< perpetual lists that are ours
  std::vector<int> native_plist_;  ///< and those that are not, in LAMMPS's order of building
  std::vector<int> needed_plist_;  ///< both: all but those that only `dch verify` looks at
  std::vector<int>
      verified_plist_;        ///< what it has LAMMPS build: ours, and what cluster pairs are compared with
  std::vector<char> needed_;  ///< by list
  std::vector<dch::lammps::ListNote> notes_;
  std::vector<ServedClusters> clusters_, requested_clusters_;  ///< of this run, of the next
  std::vector<dch::lammps::ListNote> requested_notes_;
  dch::ForcePrecision precision_ = dch::ForcePrecision::double_precision;
  dch::HierarchyParams params_;
  std::string size_reason_;    ///< why there are size classes, or none
  std::string skin_obstacle_;  ///< why the skin stays that of the script, if another one is wanted

  AtomPoints points_;
  AtomOrder order_;
  GhostImages images_;
  NeighborParts parts_;
  int threads_ = 1;
  bool tunes_skin_ = false;
  std::optional<dch::lammps::SkinTuner> tuner_;  ///< in runs with a skin that is looked for
  std::vector<double> script_cutoffs_;  ///< neighbor cutoffs by types with the skin of the script [length]
  double last_build_time_ = 0;
  bigint last_build_step_ = 0;
  dch::lammps::ExpiryRule expiry_rule_ = dch::lammps::ExpiryRule::automatic;
  std::string expiry_obstacle_ =
      "no DCH list is in use";  ///< why half the skin decides; empty if it does not
  ListExpiry expiry_;
  StockBuilds stock_builds_;
  bool stays_near_ = false;  ///< see ListExpiry::Wanted
  int half_life_ = 0;        ///< steps after which half the skin would have ended these lists; 0 if not yet
  std::unique_ptr<dch::Executor> pool_;  ///< null for one thread
  std::unique_ptr<dch::PairSearch> search_;
  SpecialPairs special_;
  GhostSides sides_;
  GhostReach reach_;
  PairRules rules_;
  ListFiller filler_;
  std::unique_ptr<ClusterListFiller> cluster_filler_;
  ListVerifier verifier_;
  ClusterVerifier cluster_verifier_;
  /// By served list and its levels, by cluster pairs, while one build is verified.
  std::vector<std::vector<dch::lammps::ListEntry>> native_entries_, reference_entries_;

  dch::lammps::RunCounters run_;
  dch::SearchStats before_run_;
};

}  // namespace LAMMPS_NS
