// SPDX-License-Identifier: MIT
// Writes the bead-spring melt of the chain cases as a LAMMPS data file: make_melt_data FILE.
#include <cstdio>
#include <exception>

#include <dch/necklace/melt.hpp>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_melt_data FILE\n");
    return 2;
  }
  try {
    dch::necklace::MeltParams params;
    params.chains = 20;
    params.beads_per_chain = 60;
    dch::necklace::write_lammps_data(argv[1], dch::necklace::make_melt(params));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_melt_data: %s\n", e.what());
    return 1;
  }
  return 0;
}
