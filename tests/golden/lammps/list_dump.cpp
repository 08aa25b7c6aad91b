// SPDX-License-Identifier: GPL-2.0-or-later
// Runs a LAMMPS script and writes the pairs of all perpetual neighbor lists, through LAMMPS's C interface
// alone, so that the comparison of lists does not rest on the code under test.
//
//     list_dump PREFIX SCRIPT [LAMMPS options]      writes PREFIX.<rank>:
//     box xlo ylo zlo xhi yhi zhi xy yz xz
//     atom ID x y z                                 for every owned atom
//     pair LIST ID_i ID_j dx dy dz SPECIAL          x_j - x_i, SPECIAL 0 to 3
#define LAMMPS_LIB_MPI  // declares lammps_open(), which takes a communicator
#include <cstdio>
#include <library.h>
#include <lmptype.h>
#include <string>
#include <vector>

namespace {

void write_box(std::FILE* out, void* lammps) {
  double lo[3], hi[3], xy, yz, xz;
  int periodic[3], change;
  lammps_extract_box(lammps, lo, hi, &xy, &yz, &xz, periodic, &change);
  std::fprintf(out, "box %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", lo[0], lo[1], lo[2], hi[0],
               hi[1], hi[2], xy, yz, xz);
}

void write_list(std::FILE* out, void* lammps, int list, const LAMMPS_NS::tagint* tag, double** x) {
  for (int row = 0; row < lammps_neighlist_num_elements(lammps, list); ++row) {
    int i = -1, count = 0;
    int* neighbors = nullptr;
    lammps_neighlist_element_neighbors(lammps, list, row, &i, &count, &neighbors);
    for (int k = 0; k < count; ++k) {
      const int j = neighbors[k] & NEIGHMASK;
      std::fprintf(out, "pair %d %lld %lld %.17g %.17g %.17g %d\n", list, static_cast<long long>(tag[i]),
                   static_cast<long long>(tag[j]), x[j][0] - x[i][0], x[j][1] - x[i][1], x[j][2] - x[i][2],
                   neighbors[k] >> SBBITS & 3);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: list_dump PREFIX SCRIPT [LAMMPS options]\n");
    return 2;
  }
  std::vector<char*> options{argv[0]};
  options.insert(options.end(), argv + 3, argv + argc);
  void* lammps = lammps_open(static_cast<int>(options.size()), options.data(), MPI_COMM_WORLD, nullptr);
  lammps_file(lammps, argv[2]);

  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::FILE* out = std::fopen((std::string(argv[1]) + "." + std::to_string(rank)).c_str(), "w");
  if (!out) {
    std::perror(argv[1]);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  const auto* tag = static_cast<LAMMPS_NS::tagint*>(lammps_extract_atom(lammps, "id"));
  auto** x = static_cast<double**>(lammps_extract_atom(lammps, "x"));
  const int owned = lammps_extract_setting(lammps, "nlocal");
  write_box(out, lammps);
  for (int i = 0; i < owned; ++i) {
    std::fprintf(out, "atom %lld %.17g %.17g %.17g\n", static_cast<long long>(tag[i]), x[i][0], x[i][1],
                 x[i][2]);
  }
  for (int list = 0; lammps_neighlist_num_elements(lammps, list) >= 0; ++list) {
    write_list(out, lammps, list, tag, x);
  }
  const bool written = std::fclose(out) == 0;
  lammps_close(lammps);
  lammps_python_finalize();
  MPI_Finalize();
  return written ? 0 : 1;
}
