// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_EWALD_SUM_H_
#define OPENMM_DCH_EWALD_SUM_H_

#include <memory>
#include <optional>
#include <utility>

#include <dch/forces/ewald_waves.hpp>

#include "ReciprocalSum.h"

namespace OpenMMDCH {

/// Ewald's own sum over waves in a rectangular box, in double.
class EwaldSum : public ReciprocalSum {
 public:
  /// @param ofPlatform  its threads; null for the caller's alone
  explicit EwaldSum(std::shared_ptr<dch::Executor> ofPlatform)
      : ReciprocalSum(dch::LatticeSum::coulomb), executor(std::move(ofPlatform)) {}

  /// Splitting and wave numbers are those that OpenMM chooses.
  void initialize(const OpenMM::System& system, const OpenMM::NonbondedForce& force) override;
  std::string computedBy() const override { return "DCH"; }

 protected:
  double addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) override;

 private:
  std::shared_ptr<dch::Executor> executor;
  std::optional<dch::EwaldWaves> waves;
};

}  // namespace OpenMMDCH

#endif
