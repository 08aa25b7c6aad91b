// SPDX-License-Identifier: MIT
// What NeighborSearch.csr() of the Python module is compared with: the same search in C++.
//
//   csr_times CUTOFF SIDE FILE      FILE: positions in a cube, three doubles each
//
// For each line of standard input it makes a list and says how many pairs there are and the seconds of the
// processor that it took.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <dch/engines/pair_search.hpp>

namespace {

std::vector<dch::Vec3> positions_in(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<dch::Vec3> positions(static_cast<std::size_t>(file.tellg()) / sizeof(dch::Vec3));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(positions.data()),
            static_cast<std::streamsize>(positions.size() * sizeof(dch::Vec3)));
  return positions;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: csr_times CUTOFF SIDE FILE\n", stderr);
    return 2;
  }
  const double cutoff = std::atof(argv[1]), side = std::atof(argv[2]);
  const std::vector<dch::Vec3> positions = positions_in(argv[3]);
  dch::ListParams list_params;
  list_params.cutoffs = dch::TypeCutoffs(cutoff);
  dch::HierarchyParams params;
  params.radius = cutoff;
  const auto search = dch::make_auto_search(params);
  for (std::string line; std::getline(std::cin, line);) {
    const std::clock_t start = std::clock();
    search->update(positions, dch::Box::orthorhombic({side, side, side}));
    const dch::NeighborList list = search->list(list_params);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%lld %.9f\n", static_cast<long long>(list.first.back()), seconds);
    std::fflush(stdout);
  }
}
