// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_REFERENCE_KERNELS_H_
#define OPENMM_DCH_REFERENCE_KERNELS_H_

#include <memory>

#include <dch/engines/verlet_list.hpp>

#include "DCHNonbondedKernelBase.h"

namespace OpenMMDCH {

/// A DCHNonbondedForce on the Reference platform: a neighbor list from double positions and a plain loop over
/// it, all in double.
class ReferenceCalcDCHNonbondedForceKernel : public DCHNonbondedKernelBase {
 public:
  using DCHNonbondedKernelBase::DCHNonbondedKernelBase;

 protected:
  double addPairs(OpenMM::ContextImpl& context, const HostState& state, bool includeEnergy) override;

 private:
  void chooseList(double room);

  std::unique_ptr<dch::VerletList> list;
  double skin = 0;  ///< of the list [nm]
};

}  // namespace OpenMMDCH

#endif
