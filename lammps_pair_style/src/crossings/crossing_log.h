// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <lammps_host.h>
#include <vector>

#include "crossing_finder.h"
#include "moving_atoms.h"

namespace LAMMPS_NS {

/// A crossing as all processes know it.
struct CrossingEvent {
  std::array<tagint, 4> tags{};
  double step = 0;  ///< when, in time steps
  dch::Vec3 place;
  int sign = 0;     ///< for bonds along their chains; 0 where one of the two bonds is in none
  int process = 0;  ///< that found it
};

/// Brings the crossings that the processes found together, in the order of time and IDs, and gives them signs
/// along chains: a chain goes from one ID to the next higher one, a ring from its highest to its lowest, and
/// no atom has three bonds. Other bonds have no direction that the processes can tell without the whole
/// chain.
///
/// Collective; costs communication in proportion to the crossings.
class CrossingLog : protected Pointers {
 public:
  using Pointers::Pointers;

  /// @param begin,end time steps of the last check and of this one
  void gather(const std::vector<BondCrossing>& mine, const MovingAtoms& atoms, double begin, double end);

  void clear() { events_.clear(); }
  const std::vector<CrossingEvent>& events() const { return events_; }

 private:
  struct Neighbors {
    int bonds = 0;
    std::array<tagint, 2> partners{};  ///< ascending if there are two
  };

  void collect(const std::vector<BondCrossing>& mine, double begin, double end);
  void find_neighbors(const MovingAtoms& atoms);
  const Neighbors& neighbors_of(tagint tag) const;
  int direction(tagint low, tagint high) const;

  std::vector<CrossingEvent> events_;
  std::vector<tagint> asked_;  ///< ascending
  std::vector<Neighbors> neighbors_;
};

}  // namespace LAMMPS_NS
