// SPDX-License-Identifier: MIT
// Writes the bead-spring melt of the chain cases as a LAMMPS data file: make_melt_data FILE [CHAINS BEADS].
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include <dch/necklace/melt.hpp>

int main(int argc, char** argv) {
  if (argc != 2 && argc != 4) {
    std::fprintf(stderr, "usage: make_melt_data FILE [CHAINS BEADS]\n");
    return 2;
  }
  try {
    dch::necklace::MeltParams params;
    params.chains = argc == 4 ? std::stoi(argv[2]) : 20;
    params.beads_per_chain = argc == 4 ? std::stoi(argv[3]) : 60;
    std::ofstream out(argv[1]);
    write_lammps_data(out, dch::necklace::make_melt(params));
    if (!out.flush()) throw std::runtime_error(std::string(argv[1]) + " cannot be written");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_melt_data: %s\n", e.what());
    return 1;
  }
  return 0;
}
