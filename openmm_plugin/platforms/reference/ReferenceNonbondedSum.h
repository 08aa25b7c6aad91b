// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_REFERENCE_NONBONDED_SUM_H_
#define OPENMM_DCH_REFERENCE_NONBONDED_SUM_H_

#include <memory>

#include <dch/engines/verlet_list.hpp>

#include "NonbondedSum.h"

namespace OpenMMDCH {

/// A nonbonded force on the Reference platform: a neighbor list from double positions and a plain loop over
/// it, all in double.
class ReferenceNonbondedSum : public NonbondedSum {
 protected:
  double addPairs(const HostState& state, bool includeEnergy) override;

 private:
  void chooseList(double room);

  std::unique_ptr<dch::VerletList> list;
  double skin = 0;  ///< of the list [nm]
};

}  // namespace OpenMMDCH

#endif
