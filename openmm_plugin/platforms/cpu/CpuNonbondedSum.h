// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CPU_NONBONDED_SUM_H_
#define OPENMM_DCH_CPU_NONBONDED_SUM_H_

#include <cstdint>
#include <optional>
#include <vector>

#include <dch/forces/all_pair_forces.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "ClusterPairKeeper.h"
#include "ContextThreads.h"
#include "NonbondedSum.h"

namespace OpenMMDCH {

/// A nonbonded force on the CPU platform: cluster pairs from double positions, SIMD kernels in single
/// precision with sums in double, on as many threads as the platform has. Without a cutoff all pairs in the
/// same way; in the few boxes where lists cannot be made, all pairs in double.
class CpuNonbondedSum : public NonbondedSum {
 public:
  /// @param asDouble  all in double, on the same threads
  CpuNonbondedSum(const OpenMM::ThreadPool& pool, bool asDouble)
      : NonbondedSum(threadsBeside(pool)), isDouble(asDouble) {}

  void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force,
                  const Splittings& splittings) override;

 protected:
  double addPairs(const HostState& state, bool includeEnergy) override;
  void parametersChanged() override;

 private:
  void makeForces();
  void setCharges(std::size_t typePairs);
  void setDispersion();
  void makeForcesOfAllPairs();
  /// In single precision, or in double where that has no value.
  double addWithoutCutoff(const HostState& state, bool includeEnergy);
  double addAllPairs(const HostState& state);
  /// Adds the forces of unresolved particles in double, and returns the energy of all pairs if it is wanted.
  double resolve(const dch::ClusterPairs& pairs, const HostState& state, bool includeEnergy) const;

  bool isDouble;
  std::optional<ClusterPairKeeper> keeper;             ///< with a cutoff
  std::optional<dch::LennardJones> forces;             ///< the same
  std::optional<dch::AllPairForces> forcesOfAllPairs;  ///< without one
  std::vector<dch::Vec3> found;                        ///< the same
  std::vector<std::int32_t> unresolved;  ///< particles whose forces by pairs of clusters have no value
  std::vector<double> charges;           ///< empty if all are 0 and dispersion has no lattice sum
  std::vector<std::vector<dch::Vec3>> forcesByThread;  ///< of all pairs
};

}  // namespace OpenMMDCH

#endif
