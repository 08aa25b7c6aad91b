// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_DROP_IN_H_
#define OPENMM_DCH_DROP_IN_H_

#include <openmm/Context.h>
#include <string>
#include <vector>

namespace OpenMMDCH {

/// The drop-in: while it is enabled, the NonbondedForces of each Context that is made, its GBSAOBCForces and
/// the CustomGBForces that openmm.app writes are computed on DCH's lists, on the platforms Reference and CPU,
/// without a change to the System. What is not covered keeps OpenMM's own kernel, and the reason is written
/// to standard error, once each.
///
/// It is enabled from the start if the environment variable OPENMM_DCH is 1. Contexts that are made already
/// are not affected. Safe to call from several threads.

/// Of the CPU platform; Reference is in double always.
enum class DropInPrecision {
  Mixed,  ///< pairs and meshes in single precision, sums in double
  Double  ///< all in double; reciprocal space by OpenMM, implicit solvent on one thread
};

/// @param precision  in Contexts from now on, of DCHNonbondedForces too
/// @throws OpenMMException if OpenMM's platform CPU is missing, and if a platform of this program lacks the
///   kernels: their plugins are not loaded, or were before OpenMM's own.
void enableDropIn(DropInPrecision precision = DropInPrecision::Mixed);
/// Contexts from now on are OpenMM's own again, DCHNonbondedForces in mixed precision.
void disableDropIn();
bool isDropInEnabled();

/// Has PME's and LJPME's sums in reciprocal space computed on meshes of ours by OpenMM's own kernels of the
/// platform CPU, which keep the pairs, in Contexts that compute forces for the first time from now on.
/// enableDropIn() does so too, for forces that are left to OpenMM; disableDropIn() ends it. Not while another
/// thread makes a Context.
///
/// @return false, and nothing changes, if another plugin has such kernels already, as OpenMM's own for PME
/// @throws OpenMMException as enableDropIn()
bool enableReciprocal();

/// Who computes a nonbonded force or one of implicit solvent: "DCH", "OpenMM", or "" for a part that the
/// force has not.
struct NonbondedStatus {
  int force;               ///< its index in the System
  std::string name;        ///< that the force has
  std::string direct;      ///< pairs
  std::string reciprocal;  ///< the sum in reciprocal space
  std::string reason;      ///< why OpenMM computes pairs, "" if it does not
};

/// Of each NonbondedForce, DCHNonbondedForce, GBSAOBCForce and CustomGBForce of the Context's System, in
/// order.
std::vector<NonbondedStatus> nonbondedStatus(const OpenMM::Context& context);

/// How many of these forces have been given to OpenMM's own kernels because the drop-in has not been enabled
/// yet; 0 once it has been.
int countOfForcesBeforeDropIn();

}  // namespace OpenMMDCH

#endif
