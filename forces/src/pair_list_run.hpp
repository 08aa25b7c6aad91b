// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>
#include <dch/lists/pair_list.hpp>

#include "lj_sums.hpp"
#include "simd/lj_task.hpp"

namespace dch::detail {

/// Forces of pairs one by one, with numbers by type.
class PairListRun {
 public:
  /// @throws InvalidParameter for another number of positions, InvalidBox for another periodicity.
  PairListRun(const PairList& pairs, Span<const Vec3> positions, const Box& now) : pairs_(pairs), now_(now) {
    if (positions.size() != pairs.particles)
      throw InvalidParameter(std::to_string(positions.size()) + " positions given for a pair list of " +
                             std::to_string(pairs.particles) +
                             " particles; make the list anew for another number");
    if (!same_periodicity(now, pairs.box))
      throw InvalidBox("a pair list made in the box " + pairs.box.description() + " was used in the box " +
                       now.description() + "; make it anew for another periodicity");
  }

  /// By particle. Pairs without types are all of type 0, as in clusters.
  const std::int32_t* types() {
    if (pairs_.type.empty()) none_.assign(pairs_.particles, 0);
    return pairs_.type.empty() ? none_.data() : pairs_.type.data();
  }

  /// @param task  but for its range and its shift
  /// @param sums  added to; null if nobody asks
  void add(LjPairTask task, LjFunctions<LjPairTask>::Function function, LennardJonesSums* sums) const {
    LjSums found;
    for (std::size_t g = 0; g + 1 < pairs_.groups.size(); ++g) {
      task.first = pairs_.groups[g].first;
      task.last = pairs_.groups[g + 1].first;
      task.shift = PairList::shift(pairs_.groups[g], now_);
      if (task.first < task.last) function(task, found);
    }
    if (sums) give(found, *sums);
  }

 private:
  const PairList& pairs_;
  const Box& now_;
  std::vector<std::int32_t> none_;
};

}  // namespace dch::detail
