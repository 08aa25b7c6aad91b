// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_DOUBLE_MESH_SUM_H_
#define OPENMM_DCH_DOUBLE_MESH_SUM_H_

#include <memory>

#include "MeshSum.h"

namespace OpenMMDCH {

/// By OpenMM's own function, in double, on one thread.
class DoubleMeshSum : public MeshSum {
 public:
  using MeshSum::MeshSum;
  double addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) override;
  std::string computedBy() const override { return "OpenMM"; }

 protected:
  void start(int particles) override;

 private:
  std::shared_ptr<void> function;  ///< what OpenMM's function keeps
};

}  // namespace OpenMMDCH

#endif
