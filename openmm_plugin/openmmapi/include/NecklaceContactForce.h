// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_NECKLACE_CONTACT_FORCE_H_
#define OPENMM_DCH_NECKLACE_CONTACT_FORCE_H_

#include <openmm/Force.h>
#include <string>
#include <vector>

namespace OpenMMDCH {

/// Two beads in contact.
struct NecklaceContact {
  int particle1 = 0, particle2 = 0;  ///< particle1 < particle2
  double gap = 0;                    ///< distance of the surfaces, negative if they overlap [nm]
};

/// A repulsion between beads of chains that touch: of a chain with itself and of chains with each other.
///
/// A chain is a list of particles, its beads, in order along it, with a radius for each; a closed chain bonds
/// its last bead to its first. Two beads repel each other where their distance r is less than the sum d of
/// their radii, unless they are bonded or near each other along one chain (setExcludedBonds()). Bonds
/// themselves are for other forces to hold. Particles in no chain do not interact.
///
/// Contacts are found with the wrapped hierarchy of bounding spheres along the chains (thesis 4.4 and 4.5)
/// or, where chains are packed, with a discrete center hierarchy over space (dch::necklace::ContactFinder).
/// Counted work decides which one, getSearchInContext() says it, and both give the same pairs. They work on
/// positions in double precision and are kept up while the chains move. Forces and energies are the same on
/// every platform, in double.
///
/// Where a method throws, it throws OpenMM::OpenMMException with the offending value. What is wrong with
/// chains as such is found when a Context is made.
class NecklaceContactForce : public OpenMM::Force {
 public:
  /// The energy of two beads at a distance r < d; it is 0 beyond. S is the strength.
  enum EnergyFunction {
    /// S ((d/r)^12 - 2 (d/r)^6 + 1), the repulsive part of a Lennard-Jones potential with its minimum at d
    /// (Weeks, Chandler, Andersen, J. Chem. Phys. 54:5237, 1971). S in kJ/mol; infinite where centers
    /// coincide, which is an error.
    WCA = 0,
    /// S/2 (d - r)^2, quadratic in the overlap of the surfaces. S in kJ/mol/nm^2. Where centers coincide
    /// there is no force, as there is no direction.
    Harmonic = 1,
    /// S (1 + cos(pi r/d)). S in kJ/mol; 2 S is the energy of coinciding beads, on which there is no force.
    SoftCosine = 2
  };

  NecklaceContactForce();

  int getNumChains() const { return static_cast<int>(chains.size()); }
  /// Of all chains.
  int getNumBeads() const;

  /// WCA if not set.
  EnergyFunction getEnergyFunction() const { return energyFunction; }
  /// @throws for a number that is none of the functions.
  void setEnergyFunction(EnergyFunction function);
  /// Not negative [kJ/mol, or kJ/mol/nm^2 for Harmonic]; 1 if not set.
  double getStrength() const { return strength; }
  void setStrength(double value) { strength = value; }
  /// Beads of one chain with so many bonds between them, around a closed chain the shorter way, and fewer do
  /// not act on each other; 1 if not set: only bonded beads. Not negative.
  int getExcludedBonds() const { return excludedBonds; }
  void setExcludedBonds(int bonds) { excludedBonds = bonds; }
  /// Whether beads of the same chain act on each other; true if not set.
  bool getActsWithinChains() const { return withinChains; }
  void setActsWithinChains(bool acts) { withinChains = acts; }
  /// Whether beads of different chains act on each other; true if not set.
  bool getActsBetweenChains() const { return betweenChains; }
  void setActsBetweenChains(bool acts) { betweenChains = acts; }
  /// Whether beads act on each other's nearest images in the periodic box, of which each bond takes the
  /// shortest way; false if not set. Then the box has to be more than twice as wide (its smallest
  /// perpendicular height) as any bond is long, at least four times as wide as the largest radius, and no
  /// closed chain may wind around it.
  void setUsesPeriodicBoundaryConditions(bool periodic) { isPeriodic = periodic; }
  bool usesPeriodicBoundaryConditions() const override { return isPeriodic; }

  /// Adds a chain and returns its index.
  /// @param particles  at least one, at least three in a closed chain; none in two chains or twice in one
  /// @param radii      positive, one for each particle [nm]
  /// @throws for another number of radii than of particles.
  int addChain(const std::vector<int>& particles, const std::vector<double>& radii, bool closed = false);
  void getChainParameters(int index, std::vector<int>& particles, std::vector<double>& radii,
                          bool& closed) const;
  /// @throws as addChain(), and for an index that does not exist.
  void setChainParameters(int index, const std::vector<int>& particles, const std::vector<double>& radii,
                          bool closed = false);

  /// Copies the radii and the strength to a Context that holds this force.
  /// @throws if the chains are not those that it was made with.
  void updateParametersInContext(OpenMM::Context& context);

  /// The pairs of beads that act on each other by the settings of the Context, with surfaces at most maxGap
  /// apart, at its present positions. In ascending order of (particle1, particle2), each pair once. As
  /// costly as finding the contacts anew.
  /// @param maxGap  [nm]; below 0 it asks for overlaps of at least -maxGap
  /// @throws if it is not finite, or too large for the periodic box.
  std::vector<NecklaceContact> getContacts(OpenMM::Context& context, double maxGap = 0);

  /// What the next search for contacts in a Context that holds this force is made with, and why, for people
  /// to read: "wrapped: ..." for the wrapped hierarchy, "dch: ..." for the hierarchy over space. The first
  /// search is the wrapped hierarchy's and measures; forces do not depend on it.
  std::string getSearchInContext(const OpenMM::Context& context) const;

 protected:
  OpenMM::ForceImpl* createImpl() const override;

 private:
  struct Chain {
    std::vector<int> particles;
    std::vector<double> radii;
    bool closed;
  };

  std::vector<Chain> chains;
  EnergyFunction energyFunction = WCA;
  double strength = 1;
  int excludedBonds = 1;
  bool withinChains = true, betweenChains = true, isPeriodic = false;
};

}  // namespace OpenMMDCH

#endif
