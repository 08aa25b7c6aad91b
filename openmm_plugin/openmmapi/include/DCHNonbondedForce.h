// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NONBONDED_FORCE_H_
#define OPENMM_DCH_NONBONDED_FORCE_H_

#include <openmm/Force.h>
#include <openmm/NonbondedForce.h>
#include <string>
#include <utility>
#include <vector>

namespace OpenMMDCH {

/// Lennard-Jones and Coulomb forces between all particles, as OpenMM's NonbondedForce computes them without a
/// cutoff or with one, on neighbor lists from a discrete center hierarchy.
///
/// The methods, units and rules are those of OpenMM::NonbondedForce: nm, kJ/mol, elementary charges;
/// Lorentz-Berthelot mixing; with a cutoff a reaction field and, if wanted, a switching function for the
/// Lennard-Jones part; exceptions without a cutoff; parameter offsets; the dispersion correction. Ewald, PME
/// and LJPME are not there: systems with those keep OpenMM's force.
///
/// Where a method throws, it throws OpenMM::OpenMMException with the offending value.
class DCHNonbondedForce : public OpenMM::Force {
 public:
  enum NonbondedMethod {
    /// All pairs, no lists.
    NoCutoff = 0,
    /// Pairs within the cutoff, with a reaction field beyond it.
    CutoffNonPeriodic = 1,
    /// The same with the nearest images in the periodic box.
    CutoffPeriodic = 2
  };

  DCHNonbondedForce();
  /// A copy of all that a NonbondedForce holds, force group and name too. Creates an object that the caller
  /// (or a System) owns.
  /// @throws for Ewald, PME and LJPME, and for a force without its direct space part.
  static DCHNonbondedForce* fromNonbonded(const OpenMM::NonbondedForce& force);

  int getNumParticles() const { return parameters.getNumParticles(); }
  int getNumExceptions() const { return parameters.getNumExceptions(); }
  int getNumGlobalParameters() const { return parameters.getNumGlobalParameters(); }
  int getNumParticleParameterOffsets() const { return parameters.getNumParticleParameterOffsets(); }
  int getNumExceptionParameterOffsets() const { return parameters.getNumExceptionParameterOffsets(); }

  NonbondedMethod getNonbondedMethod() const;
  void setNonbondedMethod(NonbondedMethod method);

  /// Where forces end [nm]; 1 nm if not set. NoCutoff does not look at it.
  double getCutoffDistance() const { return parameters.getCutoffDistance(); }
  void setCutoffDistance(double distance) { parameters.setCutoffDistance(distance); }

  /// Whether the Lennard-Jones energy is multiplied by 1 + t^3 (-10 + t (15 - 6 t)), where t goes from 0 at
  /// the switching distance to 1 at the cutoff.
  bool getUseSwitchingFunction() const { return parameters.getUseSwitchingFunction(); }
  void setUseSwitchingFunction(bool use) { parameters.setUseSwitchingFunction(use); }
  /// Not negative and less than the cutoff [nm].
  double getSwitchingDistance() const { return parameters.getSwitchingDistance(); }
  void setSwitchingDistance(double distance) { parameters.setSwitchingDistance(distance); }

  /// Relative permittivity of what is beyond the cutoff; 78.3 if not set.
  double getReactionFieldDielectric() const { return parameters.getReactionFieldDielectric(); }
  void setReactionFieldDielectric(double dielectric) { parameters.setReactionFieldDielectric(dielectric); }

  /// One call for each particle of the System, in their order. Returns the index.
  /// @param charge   [elementary charge]
  /// @param sigma    >= 0 [nm]
  /// @param epsilon  >= 0 [kJ/mol]
  int addParticle(double charge, double sigma, double epsilon);
  void getParticleParameters(int index, double& charge, double& sigma, double& epsilon) const;
  void setParticleParameters(int index, double charge, double sigma, double epsilon);

  /// Has a pair interact with these parameters, without cutoff and reaction field, in place of those of its
  /// particles; not at all if chargeProd and epsilon are 0. Returns the index.
  /// @param replace  what to do if the pair has an exception already: true replaces it, false throws
  int addException(int particle1, int particle2, double chargeProd, double sigma, double epsilon,
                   bool replace = false);
  void getExceptionParameters(int index, int& particle1, int& particle2, double& chargeProd, double& sigma,
                              double& epsilon) const;
  void setExceptionParameters(int index, int particle1, int particle2, double chargeProd, double sigma,
                              double epsilon);
  /// Leaves out pairs one and two bonds apart and scales those three bonds apart.
  void createExceptionsFromBonds(const std::vector<std::pair<int, int> >& bonds, double coulomb14Scale,
                                 double lj14Scale);

  /// A parameter of the Context that offsets can depend on.
  int addGlobalParameter(const std::string& parameter, double defaultValue);
  const std::string& getGlobalParameterName(int index) const;
  void setGlobalParameterName(int index, const std::string& parameter);
  double getGlobalParameterDefaultValue(int index) const;
  void setGlobalParameterDefaultValue(int index, double defaultValue);

  /// Adds the global parameter times these scales to the parameters of a particle.
  int addParticleParameterOffset(const std::string& parameter, int particleIndex, double chargeScale,
                                 double sigmaScale, double epsilonScale);
  void getParticleParameterOffset(int index, std::string& parameter, int& particleIndex, double& chargeScale,
                                  double& sigmaScale, double& epsilonScale) const;
  void setParticleParameterOffset(int index, const std::string& parameter, int particleIndex,
                                  double chargeScale, double sigmaScale, double epsilonScale);
  /// The same for an exception.
  int addExceptionParameterOffset(const std::string& parameter, int exceptionIndex, double chargeProdScale,
                                  double sigmaScale, double epsilonScale);
  void getExceptionParameterOffset(int index, std::string& parameter, int& exceptionIndex,
                                   double& chargeProdScale, double& sigmaScale, double& epsilonScale) const;
  void setExceptionParameterOffset(int index, const std::string& parameter, int exceptionIndex,
                                   double chargeProdScale, double sigmaScale, double epsilonScale);

  /// Whether the energy includes an estimate of the Lennard-Jones energy beyond the cutoff, from the volume
  /// of the periodic box; true if not set. As in NonbondedForce, offsets do not change it.
  bool getUseDispersionCorrection() const { return parameters.getUseDispersionCorrection(); }
  void setUseDispersionCorrection(bool useCorrection) {
    parameters.setUseDispersionCorrection(useCorrection);
  }

  /// Whether exceptions act between nearest images; they do not unless the method is CutoffPeriodic.
  bool getExceptionsUsePeriodicBoundaryConditions() const {
    return parameters.getExceptionsUsePeriodicBoundaryConditions();
  }
  void setExceptionsUsePeriodicBoundaryConditions(bool periodic) {
    parameters.setExceptionsUsePeriodicBoundaryConditions(periodic);
  }

  bool usesPeriodicBoundaryConditions() const override { return getNonbondedMethod() == CutoffPeriodic; }

  /// Copies the parameters of particles, exceptions and offsets to a Context that holds this force.
  /// @throws if their numbers, or the particles of an exception, are not what they were when it was made.
  void updateParametersInContext(OpenMM::Context& context);

  /// What this force holds, as OpenMM's own force.
  const OpenMM::NonbondedForce& getParameters() const { return parameters; }

 protected:
  OpenMM::ForceImpl* createImpl() const override;

 private:
  // Keeps exceptions and offsets by the very rules of OpenMM's force.
  OpenMM::NonbondedForce parameters;
};

}  // namespace OpenMMDCH

#endif
