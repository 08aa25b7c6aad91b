// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_RECIPROCAL_KERNEL_H_
#define OPENMM_DCH_RECIPROCAL_KERNEL_H_

#include <array>
#include <memory>
#include <openmm/internal/ContextImpl.h>
#include <openmm/kernels.h>
#include <string>
#include <utility>
#include <vector>

#include "MeshSum.h"
#include "internal/DropInRegistry.h"

namespace OpenMMDCH {

/// The sum of PME or LJPME in reciprocal space for OpenMM's own NonbondedForce on the CPU platform.
///
/// That force hands over charges, or coefficients of dispersion, beside positions in single precision. The
/// Context's positions, in double, are taken in their place, and forces go to the Context's.
/// @tparam Kernels  CalcPmeReciprocalForceKernel; for dispersion both that of dispersion and, since OpenMM
/// asks this
///                  one for the grid, that of charges
template <class... Kernels>
class ReciprocalKernel : public Kernels... {
 public:
  ReciprocalKernel(const std::string& kernelName, const OpenMM::Platform& onPlatform,
                   OpenMM::ContextImpl& ofContext, std::unique_ptr<MeshSum> ofPlatform)
      : Kernels(kernelName, onPlatform)..., context(ofContext), sum(std::move(ofPlatform)) {
    if (sum->computedBy() == "DCH") DropInRegistry::get().addMesh(context.getOwner());
  }
  ~ReciprocalKernel() override {
    if (sum->computedBy() == "DCH") DropInRegistry::get().removeMesh(context.getOwner());
  }
  ReciprocalKernel(const ReciprocalKernel&) = delete;
  ReciprocalKernel& operator=(const ReciprocalKernel&) = delete;

  /// @throws OpenMMException for a grid of less than five points along a vector
  void initialize(int nx, int ny, int nz, int particles, double alpha, bool /*deterministic*/) override {
    sum->initialize({nx, ny, nz}, alpha, particles);
    charges.resize(static_cast<std::size_t>(particles));
  }
  void beginComputation(OpenMM::CalcPmeReciprocalForceKernel::IO& io, const OpenMM::Vec3* /*boxVectors*/,
                        bool /*includeEnergy*/) override {
    const float* const posq = io.getPosq();
    for (std::size_t i = 0; i < charges.size(); ++i) charges[i] = double{posq[4 * i + 3]};
    energy = sum->addWithThemselves(context, charges);
  }
  double finishComputation(OpenMM::CalcPmeReciprocalForceKernel::IO& /*io*/) override { return energy; }
  void getPMEParameters(double& alpha, int& nx, int& ny, int& nz) const override {
    const int* const grid = sum->gridSize();
    alpha = sum->splitting();
    nx = grid[0];
    ny = grid[1];
    nz = grid[2];
  }

 private:
  OpenMM::ContextImpl& context;
  std::unique_ptr<MeshSum> sum;
  double energy = 0;
  std::vector<double> charges;
};

}  // namespace OpenMMDCH

#endif
