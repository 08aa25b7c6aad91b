// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CPU_MESH_SUM_H_
#define OPENMM_DCH_CPU_MESH_SUM_H_

#include <memory>
#include <optional>

#include <dch/forces/ewald_mesh.hpp>

#include "ContextThreads.h"
#include "MeshSum.h"

namespace OpenMMDCH {

/// By the library's mesh, in single precision, on as many threads as the platform has.
class CpuMeshSum : public MeshSum {
 public:
  CpuMeshSum(dch::LatticeSum ofWhat, const OpenMM::ThreadPool& threads)
      : MeshSum(ofWhat), executor(threadsBeside(threads)) {}
  double addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) override;
  std::string computedBy() const override { return "DCH"; }

 protected:
  void start(int particles) override;

 private:
  std::shared_ptr<dch::Executor> executor;
  std::optional<dch::EwaldMesh> mesh;
};

}  // namespace OpenMMDCH

#endif
