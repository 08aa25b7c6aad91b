// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CPU_MESH_SUM_H_
#define OPENMM_DCH_CPU_MESH_SUM_H_

#include <optional>

#include <dch/forces/ewald_mesh.hpp>

#include "MeshSum.h"
#include "PoolExecutor.h"

namespace OpenMMDCH {

/// By the library's mesh, in single precision, on the threads of the platform.
class CpuMeshSum : public MeshSum {
 public:
  CpuMeshSum(dch::LatticeSum ofWhat, OpenMM::ThreadPool& threads) : MeshSum(ofWhat), executor(threads) {}
  double addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) override;
  std::string computedBy() const override { return "DCH"; }

 protected:
  void start(int particles) override;

 private:
  PoolExecutor executor;
  std::optional<dch::EwaldMesh> mesh;
};

}  // namespace OpenMMDCH

#endif
