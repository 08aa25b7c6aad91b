// SPDX-License-Identifier: MIT
#include "DoubleMeshSum.h"

#include <openmm/reference/ReferencePME.h>
#include <openmm/reference/ReferencePlatform.h>

namespace OpenMMDCH {
namespace {

constexpr int kOrder = 5;  // of the splines, as in OpenMM

}  // namespace

void DoubleMeshSum::start(int particles) {
  OpenMM::pme_t made = nullptr;
  OpenMM::pme_init(&made, alpha, particles, grid, kOrder, 1);
  function.reset(static_cast<void*>(made),
                 [](void* kept) { OpenMM::pme_destroy(static_cast<OpenMM::pme_t>(kept)); });
}

double DoubleMeshSum::addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) {
  auto& data = *static_cast<OpenMM::ReferencePlatform::PlatformData*>(context.getPlatformData());
  double energy = 0;
  const auto run = isOfDispersion() ? &OpenMM::pme_exec_dpme : &OpenMM::pme_exec;
  run(static_cast<OpenMM::pme_t>(function.get()), *data.positions, *data.forces, charges,
      data.periodicBoxVectors, &energy);
  return energy;
}

}  // namespace OpenMMDCH
