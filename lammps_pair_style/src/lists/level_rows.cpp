// SPDX-License-Identifier: GPL-2.0-or-later
#include "level_rows.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <cstdint>
#include <limits>
#include <neigh_list.h>
#include <neighbor.h>
#include <utility>

#include <dch/base/vec3.hpp>

#include "list_filler.h"

namespace LAMMPS_NS {

LevelBounds bounds_of(PairLevel level, const Neighbor& neighbor) {
  if (level == PairLevel::inner) return {-1, neighbor.cut_inner_sq};
  return {neighbor.cut_middle_inside_sq, neighbor.cut_middle_sq};
}

LevelRows rows_of(const NeighList& list, PairLevel level) {
  if (level == PairLevel::inner) return {list.ilist_inner, list.numneigh_inner, list.firstneigh_inner};
  if (level == PairLevel::middle) return {list.ilist_middle, list.numneigh_middle, list.firstneigh_middle};
  return {list.ilist, list.numneigh, list.firstneigh};
}

std::vector<PairLevel> levels_of(const NeighList& list) {
  std::vector<PairLevel> levels{PairLevel::all};
  if (list.respamiddle) levels.push_back(PairLevel::middle);
  if (list.respainner) levels.push_back(PairLevel::inner);
  return levels;
}

const char* name_of(PairLevel level) {
  if (level == PairLevel::all) return "";
  return level == PairLevel::inner ? "inner level" : "middle level";
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Squared distances between the groups in which the pairs of a level stand, -infinity and infinity included.
/// A pair style asks of each pair whether it is within one or another of r-RESPA's cutoffs, which is foretold
/// best where pairs with the same answers stand together.
std::vector<double> edges_of_groups(LevelBounds bounds, const Neighbor& neighbor) {
  const double first = std::sqrt(neighbor.cut_middle_inside_sq) + neighbor.skin,
               second = std::sqrt(neighbor.cut_inner_sq) - neighbor.skin,
               last = std::sqrt(neighbor.cut_middle_sq) - neighbor.skin;
  std::vector<double> edges{-kInfinity, kInfinity};
  for (const double cutoff : {first, second, last})
    if (bounds.hold(cutoff * cutoff)) edges.push_back(cutoff * cutoff);
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// A level while it is filled.
class Level {
 public:
  Level(LevelBounds bounds, std::vector<double> edges, LevelRows rows, std::vector<std::int32_t>& entries)
      : bounds_(bounds), edges_(std::move(edges)), rows_(rows), entries_(entries) {
    entries_.clear();
  }

  /// @param r2 squared distances of the entries of row i, the kth of an owner
  void take_row(int k, int i, const std::int32_t* row, const std::vector<double>& r2) {
    found_.resize(r2.size() + 1);  // what is not kept is written behind the last one
    std::size_t n = 0;
    for (std::size_t e = 0; e + 1 < edges_.size(); ++e)
      n = append_group(edges_[e], edges_[e + 1], row, r2, n);
    entries_.insert(entries_.end(), found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(n));
    rows_.ilist[k] = i;
    rows_.numneigh[i] = static_cast<int>(n);
  }

  /// When all have been taken, entries stay where they are.
  void place_rows(int owners) {
    std::int32_t* next = entries_.data();
    for (int k = 0; k < owners; ++k) {
      const int i = rows_.ilist[k];
      rows_.firstneigh[i] = next;
      next += rows_.numneigh[i];
    }
  }

 private:
  /// Without a branch for each neighbor.
  std::size_t append_group(double from, double to, const std::int32_t* row, const std::vector<double>& r2,
                           std::size_t n) {
    std::int32_t* const found = found_.data();
    const LevelBounds bounds = bounds_;
    for (std::size_t m = 0; m < r2.size(); ++m) {
      found[n] = row[m];
      n += static_cast<std::size_t>(bounds.hold(r2[m]) & (from <= r2[m]) & (r2[m] < to));
    }
    return n;
  }

  LevelBounds bounds_;
  std::vector<double> edges_;
  LevelRows rows_;
  std::vector<std::int32_t>& entries_;
  std::vector<std::int32_t> found_;
};

}  // namespace

void fill_levels(const Atom& atom, const Neighbor& neighbor, ServedList& served, NeighList& list) {
  std::vector<Level> levels;
  for (const PairLevel level : levels_of(list)) {
    if (level == PairLevel::all) continue;
    const LevelBounds bounds = bounds_of(level, neighbor);
    levels.emplace_back(bounds, edges_of_groups(bounds, neighbor), rows_of(list, level),
                        level == PairLevel::inner ? served.inner : served.middle);
  }
  list.inum_inner = list.respainner ? list.inum : 0;
  list.inum_middle = list.respamiddle ? list.inum : 0;
  if (levels.empty() || list.inum == 0) return;
  const auto* const x = reinterpret_cast<const dch::Vec3*>(atom.x[0]);
  std::vector<double> r2;
  for (int k = 0; k < list.inum; ++k) {
    const int i = list.ilist[k];
    const std::int32_t* const row = list.firstneigh[i];
    r2.resize(static_cast<std::size_t>(list.numneigh[i]));
    for (std::size_t m = 0; m < r2.size(); ++m) r2[m] = norm2(x[i] - x[row[m] & NEIGHMASK]);
    for (Level& level : levels) level.take_row(k, i, row, r2);
  }
  for (Level& level : levels) level.place_rows(list.inum);
}

}  // namespace LAMMPS_NS
