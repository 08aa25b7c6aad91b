// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <dch/hierarchy.hpp>
#include <dch/pair_search.hpp>

namespace dch::lammps {

/// Makes the search structure for some parameters; make_dch_search, but for tests.
using SearchFactory = std::unique_ptr<PairSearch> (*)(const HierarchyParams&);

/// A search structure kept up over the points of a run, and the candidate rows that lists are filled from:
/// one set of rows serves all lists that are alike.
class CandidateRows {
 public:
  explicit CandidateRows(SearchFactory factory) : factory_(factory) {}

  /// Makes a new structure if these parameters differ from the present ones.
  /// @throws InvalidParameter as the factory does.
  void prepare(const HierarchyParams& params);

  /// Takes new points; all rows are void.
  /// @throws as PairSearch::update.
  void update(Span<const Vec3> positions, Span<const std::uint64_t> keys);

  /// The rows for a list with this kind and first ghost (as in ListParams), at most as wide as the
  /// structure's radius.
  /// @throws as PairSearch::list.
  const NeighborList& rows(const ListParams& params);

  const SearchStats& stats() const { return search_ ? search_->stats() : no_stats_; }

 private:
  struct Entry {
    bool full, ghosts, valid;
    NeighborList rows;
  };
  SearchFactory factory_;
  SearchStats no_stats_;
  std::unique_ptr<PairSearch> search_;
  HierarchyParams params_;
  std::vector<Entry> entries_;
};

}  // namespace dch::lammps
