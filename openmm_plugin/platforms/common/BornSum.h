// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_BORN_SUM_H_
#define OPENMM_DCH_BORN_SUM_H_

#include <memory>
#include <openmm/internal/ContextImpl.h>
#include <vector>

#include <dch/engines/verlet_list.hpp>

#include "BornModel.h"
#include "HostState.h"

namespace OpenMMDCH {

/// A generalized Born model with a cutoff, on a platform on the processor: integrals of all particles, their
/// Born radii, energies and forces of pairs at these radii, and forces by the chain rule. Here all is in
/// double, by plain loops over a neighbor list; the CPU platform computes pairs in a way of its own.
class BornSum {
 public:
  virtual ~BornSum() = default;

  /// Takes a model without fault.
  virtual void take(const BornModel& taken) { model = taken; }
  const BornModel& taken() const { return model; }
  /// Adds forces to those of the Context [kJ/mol/nm] and returns the energy [kJ/mol].
  /// @throws OpenMMException for a box that is too small and for positions that are not finite
  double add(OpenMM::ContextImpl& context, bool includeEnergy);

 protected:
  /// Brings pairs up to date.
  virtual void follow(const HostState& state);
  /// Adds the integral of each particle.
  virtual void addIntegrals(const HostState& state);
  /// Adds the forces at constant Born radii, and dE/dB to slopes. Returns the energy, if it is wanted.
  virtual double addEnergies(const HostState& state, bool includeEnergy);
  /// Adds the forces by the chain rule, from dE/dI in slopes.
  virtual void addChain(const HostState& state);

  BornModel model;
  std::vector<double> integrals, radii, slopes;  ///< by particle; the last are dE/dB, then dE/dI

 private:
  /// From integrals to Born radii and their slopes; and the energy of particles by themselves.
  double addParticles();
  void chooseList(double room);
  /// Calls act(i, j, from i to j, squared distance) for the pairs within the cutoff.
  template <class Act>
  void forEachPair(const HostState& state, const Act& act) const;

  std::vector<double> radiusSlopes;  ///< dB/dI
  std::unique_ptr<dch::VerletList> list;
  bool fits = false;  ///< whether lists can be made in this box
  double skin = 0;    ///< of the list [nm]
};

}  // namespace OpenMMDCH

#endif
