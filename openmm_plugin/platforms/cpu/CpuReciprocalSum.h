// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CPU_RECIPROCAL_SUM_H_
#define OPENMM_DCH_CPU_RECIPROCAL_SUM_H_

#include <optional>

#include <dch/forces/ewald_mesh.hpp>

#include "PoolExecutor.h"
#include "ReciprocalSum.h"

namespace OpenMMDCH {

/// By the library's mesh, in single precision, on the threads of the platform.
class CpuReciprocalSum : public ReciprocalSum {
 public:
  explicit CpuReciprocalSum(OpenMM::ThreadPool& threads) : executor(threads) {}
  std::string computedBy() const override { return "DCH"; }

 protected:
  void start(int particles) override;
  double addMesh(OpenMM::ContextImpl& context, const std::vector<double>& charges) override;

 private:
  PoolExecutor executor;
  std::optional<dch::EwaldMesh> mesh;
};

}  // namespace OpenMMDCH

#endif
