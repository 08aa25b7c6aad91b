// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_PARAMETER_SET_H_
#define OPENMM_DCH_PARAMETER_SET_H_

#include <map>
#include <openmm/NonbondedForce.h>
#include <openmm/internal/ContextImpl.h>
#include <string>
#include <vector>

namespace OpenMMDCH {

/// The parameters of a nonbonded force with those offsets added that the Context's global parameters ask
/// for.
class DCHParameterSet {
 public:
  struct Particle {
    double charge, sigma, epsilon;
  };
  struct Exception {
    int particle1, particle2;
    double chargeProd, sigma, epsilon;
    bool acts() const { return chargeProd != 0 || epsilon != 0; }
  };

  explicit DCHParameterSet(const OpenMM::NonbondedForce& force);

  /// Takes the parameters of a force anew.
  /// @throws OpenMMException if the number of particles or exceptions has changed, or the particles of an
  ///   exception, and for an offset of a particle or an exception that does not exist; nothing is taken then.
  void take(const OpenMM::NonbondedForce& force);

  /// Follows the Context's global parameters. Says whether anything has changed since the last call.
  /// @throws OpenMMException if a sigma or an epsilon is negative, by an offset or since an update, or a
  ///   number of a particle is not finite.
  bool follow(OpenMM::ContextImpl& context);

  const std::vector<Particle>& particles() const { return nowParticles; }
  const std::vector<Exception>& exceptions() const { return nowExceptions; }
  /// Whether a particle has a charge.
  bool hasCharges() const { return anyCharge; }

 private:
  struct Offset {
    std::string parameter;
    int index;
    double charge, sigma, epsilon;
  };
  void takeOffsets(const OpenMM::NonbondedForce& force);
  void evaluate(OpenMM::ContextImpl& context);

  std::vector<Particle> baseParticles, nowParticles;
  std::vector<Exception> baseExceptions, nowExceptions;
  std::vector<Offset> particleOffsets, exceptionOffsets;
  std::map<std::string, double> globals;  ///< that offsets depend on, as of the last evaluation
  bool isCurrent = false, anyCharge = false;
};

}  // namespace OpenMMDCH

#endif
