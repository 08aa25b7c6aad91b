// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_SUM_H_
#define OPENMM_DCH_NONBONDED_SUM_H_

#include <memory>
#include <openmm/NonbondedForce.h>
#include <openmm/System.h>
#include <openmm/internal/ContextImpl.h>
#include <optional>
#include <utility>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>

#include "HostState.h"
#include "PairPotential.h"
#include "internal/DCHParameterSet.h"

namespace OpenMMDCH {

/// The pairs of a nonbonded force, its exceptions and its dispersion correction, on a platform on the
/// processor. Of a lattice sum this is the part in direct space.
class NonbondedSum {
 public:
  /// @param ofPlatform  its threads; null for the caller's alone
  explicit NonbondedSum(std::shared_ptr<dch::Executor> ofPlatform = nullptr)
      : executor(std::move(ofPlatform)) {}
  virtual ~NonbondedSum() = default;

  /// @param force  has been checked
  virtual void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force,
                          const Splittings& splittings);
  /// Takes parameters anew.
  /// @throws OpenMMException if numbers of particles or exceptions have changed
  void copyParameters(const OpenMM::System& system, const OpenMM::NonbondedForce& force);
  /// Follows the global parameters of the Context: comes before add() and parameters().
  void follow(OpenMM::ContextImpl& context);
  /// Adds forces to those of the Context [kJ/mol/nm] and returns the energy [kJ/mol].
  /// @throws OpenMMException for a box that is too small and for positions that are not finite
  double add(OpenMM::ContextImpl& context, bool includeEnergy);

  const DCHParameterSet& parameters() const { return *parameterSet; }
  const PairPotential& potential() const { return *pairPotential; }

 protected:
  /// Adds the forces of all pairs that are not excluded and, if that is asked for, returns their energy.
  virtual double addPairs(const HostState& state, bool includeEnergy) = 0;
  /// The parameters are not those of the last time (or it is the first).
  virtual void parametersChanged() {}

  const dch::Exclusions& exclusions() const { return excludedPairs; }
  dch::Executor* threads() const { return executor.get(); }

  /// Adds the forces of particles i and j and returns their energy.
  double addPair(const HostState& state, std::size_t i, std::size_t j, dch::Span<dch::Vec3> forces) const;
  /// The same for all pairs of particles with the smaller index first, first + stride, ...
  double addRows(const HostState& state, std::size_t first, std::size_t stride,
                 dch::Span<dch::Vec3> forces) const;
  /// What looks at all pairs sees positions that are not finite no other way.
  /// @throws OpenMMException that names the first particle with one
  static void checkPositions(dch::Span<const dch::Vec3> positions);

 private:
  HostState stateOf(OpenMM::ContextImpl& context) const;
  /// What an exception gives its particles.
  struct ExceptionTerms {
    dch::Vec3 force;  ///< on the second one; the first has the opposite one [kJ/mol/nm]
    double energy = 0;
  };
  double addExceptions(const HostState& state);
  ExceptionTerms termsOf(const HostState& state, const DCHParameterSet::Exception& exception) const;

  std::shared_ptr<dch::Executor> executor;
  bool isPeriodic = false, exceptionsArePeriodic = false, isFollowed = false;
  std::optional<DCHParameterSet> parameterSet;
  std::optional<PairPotential> pairPotential;
  dch::Exclusions excludedPairs;
  double dispersionCoefficient = 0;  ///< energy times volume [kJ/mol nm^3]
  std::vector<ExceptionTerms> exceptionTerms;
};

}  // namespace OpenMMDCH

#endif
