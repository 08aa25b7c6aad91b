// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Pairs of particles one by one, each with the image of the second particle that is meant: for force loops
/// where neighbors are few, so that clusters of four (ClusterPairs) would look at many pairs in vain. It
/// holds no positions, and stays complete as long as StaleTest's condition holds for the list that it was
/// made from.
struct PairList {
  /// Pairs of the same image, up to the next group.
  struct Group {
    std::array<std::int32_t, 3> image{};  ///< multiples of the cell vectors to add to second particles
    std::int64_t first = 0;
  };

  std::vector<std::int32_t> i, j;
  std::vector<Group> groups;       ///< and one more, for the end of the last
  std::vector<std::int32_t> type;  ///< by particle; empty if there is one type
  int types = 1;                   ///< more than any type
  std::size_t particles = 0;
  double list_radius = 0;  ///< [length]
  Box box;                 ///< of the positions that it was made from

  std::int64_t pairs() const { return static_cast<std::int64_t>(i.size()); }
  std::size_t memory_bytes() const {
    return (i.capacity() + j.capacity() + type.capacity()) * sizeof(std::int32_t) +
           groups.capacity() * sizeof(Group);
  }

  /// The vector to add to second particles of a group in a cell that has changed its shape since [length].
  static Vec3 shift(const Group& group, const Box& now);

  /// Calls f(i, j, displacement from i to j) for every pair.
  template <class F>
  void for_each(Span<const Vec3> positions, const Box& now, const F& f) const {
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
      const Vec3 by = shift(groups[g], now);
      for (auto k = static_cast<std::size_t>(groups[g].first);
           k < static_cast<std::size_t>(groups[g + 1].first); ++k)
        f(i[k], j[k],
          positions[static_cast<std::size_t>(j[k])] + by - positions[static_cast<std::size_t>(i[k])]);
    }
  }
};

/// Makes a PairList of the pairs of a half list at the positions that the list is of. Those of a list with a
/// shell (ListParams::shell) are sorted by it, near ones first in each group: kernels, which look at several
/// at once, are done faster with those where nothing acts. `out` is overwritten;
/// its memory is used again, and it is empty after a throw. From then on particles may leave the cell, but
/// not be wrapped into it. O(pairs).
/// @param accept called as accept(i, j) for every pair; those that it refuses are left out
/// @param list_radius cutoff + skin of the list [length]
/// @param types by particle, or none if there is one type
/// @throws InvalidPosition for positions more periods away from each other's nearest images than 32-bit
/// numbers count; InvalidParameter for a full list, another number of positions or types than rows, and a
/// negative
///   type.
template <class Accept>
void make_pair_list(const NeighborList& list, double list_radius, Span<const Vec3> positions, const Box& box,
                    Span<const std::int32_t> types, const Accept& accept, PairList& out);

namespace detail {

/// Takes pairs for a PairList, those of the home image first.
class PairListMaker {
 public:
  /// @throws InvalidParameter as make_pair_list()
  PairListMaker(const NeighborList& list, double list_radius, Span<const Vec3> positions, const Box& box,
                Span<const std::int32_t> types, PairList& out);
  /// @param is_wanted  else it is left out; without a branch where there are no images, as which pairs are
  /// wanted cannot be foretold
  void add(std::int32_t i, std::int32_t j, bool is_wanted) {
    const bool is_near = !has_images_ || is_nearest(i, j);
    out_.i[near_] = i;  // there is room; what is far or left out is overwritten by the next
    out_.j[near_] = j;
    near_ += is_near & is_wanted ? 1 : 0;
    if (!is_near && is_wanted) far_.push_back({i, j});
  }
  void finish();

 private:
  bool is_nearest(std::int32_t i, std::int32_t j) const {
    return norm2(positions_[static_cast<std::size_t>(j)] - positions_[static_cast<std::size_t>(i)]) <= near2_;
  }
  std::size_t group_of(const std::array<std::int32_t, 3>& image);

  Span<const Vec3> positions_;
  bool has_images_;  ///< else no position is looked at
  double near2_;     ///< below this no other image is nearer
  PairList& out_;
  std::size_t near_ = 0;  ///< pairs of the home image
  std::vector<std::array<std::int32_t, 2>> far_;
};

}  // namespace detail

template <class Accept>
void make_pair_list(const NeighborList& list, double list_radius, Span<const Vec3> positions, const Box& box,
                    Span<const std::int32_t> types, const Accept& accept, PairList& out) try {
  detail::PairListMaker maker(list, list_radius, positions, box, types, out);
  const auto take = [&](std::size_t row, std::int64_t first, std::int64_t last) {
    const std::int32_t i = list.particle.empty() ? static_cast<std::int32_t>(row) : list.particle[row];
    for (std::int64_t k = first; k < last; ++k) {
      const std::int32_t j = list.j[static_cast<std::size_t>(k)];
      maker.add(i, j, accept(i, j));
    }
  };
  const bool has_shell = !list.near_end.empty();
  for (std::size_t row = 0; row < list.size(); ++row)
    take(row, list.first[row], has_shell ? list.near_end[row] : list.first[row + 1]);
  for (std::size_t row = 0; has_shell && row < list.size(); ++row)
    take(row, list.near_end[row], list.first[row + 1]);
  maker.finish();
} catch (...) {
  out = PairList();
  throw;
}

}  // namespace dch
#pragma GCC visibility pop
