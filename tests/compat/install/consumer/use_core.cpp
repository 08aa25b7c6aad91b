// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/all_pairs.hpp>

int main() {
  std::vector<dch::Vec3> positions;
  for (int k = 0; k < 200; ++k) positions.push_back({0.37 * k, 0.71 * k, 0.13 * k * k});
  const dch::Box box = dch::Box::orthorhombic({9, 10, 11});
  dch::ListParams params;
  params.cutoffs = dch::TypeCutoffs(2.0);

  const dch::NeighborList expected = dch::all_pairs(positions, box, params);
  auto dch_search = dch::make_dch_search(params.list_radius());
  auto cell_search = dch::make_cell_search(params.list_radius());
  for (dch::PairSearch* search : {dch_search.get(), cell_search.get()}) {
    search->update(positions, box);
    if (search->list(params).j != expected.j) {
      std::fprintf(stderr, "%s differs from all pairs\n", search->name().c_str());
      return 1;
    }
  }
  return expected.pairs() > 0 ? 0 : 1;
}
