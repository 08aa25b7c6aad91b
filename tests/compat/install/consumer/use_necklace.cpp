// SPDX-License-Identifier: MIT
#include <dch/necklace/chains.hpp>
#include <dch/necklace/melt.hpp>

int main() {
  dch::necklace::MeltParams params;
  params.chains = 4;
  const dch::necklace::Melt melt = dch::necklace::make_melt(params);
  const auto chains = dch::necklace::Chains::from_molecules(melt.molecules);
  return chains.size() == 4 && chains.bonds() == melt.bonds ? 0 : 1;
}
