// SPDX-License-Identifier: MIT
#include "DoubleMeshSum.h"

#include <openmm/reference/ReferencePME.h>
#include <openmm/reference/ReferencePlatform.h>

#include "HostErrors.h"

namespace OpenMMDCH {
namespace {

using PlatformData = OpenMM::ReferencePlatform::PlatformData;
constexpr int kOrder = 5;  // of the splines, as in OpenMM

// A class from OpenMM 8.5 on, the first to have LCPOForce; functions before.
#if __has_include(<openmm/LCPOForce.h>)

std::shared_ptr<void> makeFunction(double alpha, int particles, const int* grid) {
  return std::make_shared<OpenMM::ReferencePME>(alpha, particles, grid, kOrder, 1.0);
}

void execute(void* function, bool isOfDispersion, PlatformData& data, const std::vector<double>& charges,
             double& energy) {
  const auto run = isOfDispersion ? &OpenMM::ReferencePME::exec_dpme : &OpenMM::ReferencePME::exec;
  (static_cast<OpenMM::ReferencePME*>(function)->*run)(*data.positions, *data.forces, charges,
                                                       data.periodicBoxVectors, energy);
}

#else

std::shared_ptr<void> makeFunction(double alpha, int particles, const int* grid) {
  OpenMM::pme_t made = nullptr;
  OpenMM::pme_init(&made, alpha, particles, grid, kOrder, 1);
  return {static_cast<void*>(made),
          [](void* kept) { OpenMM::pme_destroy(static_cast<OpenMM::pme_t>(kept)); }};
}

void execute(void* function, bool isOfDispersion, PlatformData& data, const std::vector<double>& charges,
             double& energy) {
  const auto run = isOfDispersion ? &OpenMM::pme_exec_dpme : &OpenMM::pme_exec;
  run(static_cast<OpenMM::pme_t>(function), *data.positions, *data.forces, charges, data.periodicBoxVectors,
      &energy);
}

#endif

}  // namespace

/// OpenMM's function does not look at its numbers, and ends the program without a grid.
void DoubleMeshSum::start(int particles) {
  withErrorsOfHost([&] { dch::EwaldMesh(std::array<int, 3>{grid[0], grid[1], grid[2]}, alpha, 1, what); });
  function = makeFunction(alpha, particles, grid);
}

double DoubleMeshSum::addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) {
  double energy = 0;
  execute(function.get(), isOfDispersion(), *static_cast<PlatformData*>(context.getPlatformData()), charges,
          energy);
  return energy;
}

}  // namespace OpenMMDCH
