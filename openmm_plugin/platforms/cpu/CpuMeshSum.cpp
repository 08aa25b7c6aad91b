// SPDX-License-Identifier: MIT
#include "CpuMeshSum.h"

#include <algorithm>

#include "HostErrors.h"
#include "HostState.h"
#include "PairPotential.h"

namespace OpenMMDCH {

void CpuMeshSum::start(int) {
  withErrorsOfHost([&] {
    mesh.emplace(std::array<int, 3>{grid[0], grid[1], grid[2]}, alpha,
                 isOfDispersion() ? 1 : PairPotential::coulombConstant(), what);
  });
  mesh->set_executor(executor.get());
  const std::array<int, 3> sizes = mesh->sizes();
  std::copy(sizes.begin(), sizes.end(), grid);
}

double CpuMeshSum::addWithThemselves(OpenMM::ContextImpl& context, const std::vector<double>& charges) {
  const HostState state = hostStateOf(context, true);
  return withErrorsOfHost(
      [&] { return mesh->add_forces(state.positions, charges, state.box, state.forces); });
}

}  // namespace OpenMMDCH
