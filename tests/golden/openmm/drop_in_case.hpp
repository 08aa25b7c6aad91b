// SPDX-License-Identifier: MIT
#pragma once

#include "random_systems.hpp"

namespace OpenMMDCH {

using OpenMM::NonbondedForce;

/// OpenMM's own NonbondedForce by the drop-in.
class DropInTest : public OnPlatform {
 protected:
  /// In single precision forces are within 5e-6 of their root mean square.
  double tolerance() const { return GetParam() == "Reference" ? 1e-10 : 5e-6; }
  std::unique_ptr<Host> drop_in(const OpenMM::System& system) const {
    return std::make_unique<Host>(system, kDropIn + GetParam());
  }
  /// Energies are small sums of large ones: in single precision within 1e-5 kJ/mol an atom.
  void expect_energy(const Evaluation& expected, const Evaluation& found, const std::string& what) const {
    const double allowed = 1e-5 * static_cast<double>(expected.forces.size());
    if (GetParam() == "Reference")
      expect_near(expected.energy, found.energy, 1e-9, what);
    else
      EXPECT_NEAR(found.energy, expected.energy, allowed) << what;
  }
};

inline const NonbondedForce& force_in(Host& host) {
  return dynamic_cast<const NonbondedForce&>(host->getSystem().getForce(0));
}

inline double splitting_of_pme(Host& host) {
  double alpha;
  int nx, ny, nz;
  force_in(host).getPMEParametersInContext(*host, alpha, nx, ny, nz);
  return alpha;
}

/// Splitting and sizes of the grid.
inline std::vector<double> parameters_of_ljpme(Host& host) {
  double alpha;
  int n[3];
  force_in(host).getLJPMEParametersInContext(*host, alpha, n[0], n[1], n[2]);
  return {alpha, 1.0 * n[0], 1.0 * n[1], 1.0 * n[2]};
}

/// Of OpenMM's choice; 0 without a lattice sum.
inline OracleSplittings splittings_of(Host& host) {
  const NonbondedForce& force = force_in(host);
  if (force.getNonbondedMethod() == NonbondedForce::PME) return {splitting_of_pme(host), 0};
  if (force.getNonbondedMethod() == NonbondedForce::LJPME)
    return {splitting_of_pme(host), parameters_of_ljpme(host)[0]};
  if (force.getNonbondedMethod() != NonbondedForce::Ewald) return {};
  return {std::sqrt(-std::log(2 * force.getEwaldErrorTolerance())) / force.getCutoffDistance(), 0};
}

/// Ewald sums are for rectangular boxes only.
inline bool is_skewed(const RandomSystem& made) {
  return made.box[1][0] != 0 || made.box[2][0] != 0 || made.box[2][1] != 0;
}

inline void make_rectangular(RandomSystem& made) {
  made.system.setDefaultPeriodicBoxVectors(Vec3(made.box[0][0], 0, 0), Vec3(0, made.box[1][1], 0),
                                           Vec3(0, 0, made.box[2][2]));
}

}  // namespace OpenMMDCH
