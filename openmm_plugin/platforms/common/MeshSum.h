// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_MESH_SUM_H_
#define OPENMM_DCH_MESH_SUM_H_

#include <array>

#include "ReciprocalSum.h"

namespace OpenMMDCH {

/// Particle mesh Ewald.
class MeshSum : public ReciprocalSum {
 public:
  using ReciprocalSum::ReciprocalSum;

  /// Grid and splitting are those that OpenMM chooses; a platform may have a finer grid.
  void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) override;
  /// With a grid and a splitting that somebody else has chosen.
  void initialize(const std::array<int, 3>& chosenGrid, double chosenSplitting, int particles);
  const int* gridSize() const override { return grid; }

 protected:
  /// The grid is known.
  virtual void start(int particles) = 0;

  int grid[3]{};
};

}  // namespace OpenMMDCH

#endif
